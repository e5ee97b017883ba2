"""Lines to decode, good and bad, in pieces of any size; and their events, made comparable."""

from collections.abc import Iterable
from itertools import pairwise
from typing import Any, TypeAlias

from busservo import Direction, Message, Noise, Reason, StreamDecoder, UnknownFrame, strategies
from hypothesis import strategies as st

DIRECTIONS = (Direction.HOST_TO_CONTROLLER, Direction.CONTROLLER_TO_HOST, None)

Event: TypeAlias = Message | Noise


# Beginnings that cost a decoder most: legal as far as they go, claiming much, or nearly a header.
HEADS = (
    *(b"\x55", b"\x55\x55", b"\x55\x55\x55"),
    *(bytes.fromhex(f"55 55 {head}") for head in ("05 06", "08 03 01", "0B 03", "55 14 52")),
    *(bytes.fromhex(f"55 55 {head}") for head in ("55 63", "FE 03 53", "FF", "FF 14 FC")),
    *(bytes.fromhex(f"55 55 {head}") for head in ("FF 15", "FF 15 54", "FF 63")),
)

directions = st.sampled_from(DIRECTIONS)


@st.composite
def damaged_frames(draw: st.DrawFn) -> bytes:
    """Return a frame of either direction with bytes lost, changed, repeated or inserted."""
    frame = draw(strategies.messages()).encode()
    # Most of what makes a frame one is at its beginning, so that most of the damage belongs there.
    start = draw(st.integers(0, min(6, len(frame)) - 1) | st.integers(0, len(frame) - 1))
    end = draw(st.integers(start, min(start + 3, len(frame))) | st.just(len(frame)))
    return frame[:start] + draw(st.binary(max_size=3) | st.sampled_from(HEADS)) + frame[end:]


@st.composite
def unknown_frames(draw: st.DrawFn) -> bytes:
    """Return the shape of a frame, with a command of neither direction, and no 55 after it."""
    command = draw(st.integers(0, 255).filter(lambda number: number not in _COMMANDS))
    parameters = draw(st.binary(max_size=12)).replace(b"\x55", b"\x56")
    return bytes([0x55, 0x55, len(parameters) + 2, command]) + parameters


_COMMANDS = {3, 6, 7, 8, 11, 15, 20, 21, 0x55}

lines = st.lists(
    st.one_of(
        strategies.messages().map(Message.encode),
        damaged_frames(),
        unknown_frames(),
        st.sampled_from(HEADS),
        st.lists(st.sampled_from([0x55, 0x55, 0, 2, 3, 5, 6, 7, 8, 20, 21]), max_size=12).map(
            bytes
        ),
        strategies.noise(max_size=8),
    ),
    max_size=6,
).map(b"".join)


@st.composite
def pieces(draw: st.DrawFn, line: bytes) -> list[bytes]:
    """Return `line`, cut anywhere, also into single bytes, with empty pieces among the others."""
    if draw(st.booleans()):
        return single_bytes(line)
    cuts = sorted(draw(st.lists(st.integers(0, len(line)), max_size=12)))
    return [line[start:end] for start, end in pairwise([0, *cuts, len(line)])]


def single_bytes(line: bytes) -> list[bytes]:
    return [line[at : at + 1] for at in range(len(line))]


def read(
    direction: Direction | None, chunks: Iterable[bytes], *, quiet: bool = True
) -> list[Event]:
    """Return all events of a new decoder for these chunks, and, with `quiet`, of their end."""
    decoder = StreamDecoder(direction)
    events: list[Event] = [event for chunk in chunks for event in decoder.feed(chunk)]
    return [*events, *decoder.flush()] if quiet else events


def messages_in(events: Iterable[Event]) -> list[Message]:
    """Return the messages alone."""
    return [event for event in events if isinstance(event, Message)]


def unknown_in(events: Iterable[Event]) -> list[UnknownFrame]:
    """Return the unknown frames alone."""
    return [event for event in events if isinstance(event, UnknownFrame)]


def bytes_of(events: Iterable[Event]) -> bytes:
    """Return the bytes that the events account for, in order."""
    return b"".join(
        event.encode() if isinstance(event, Message) else event.data for event in events
    )


def joined(events: Iterable[Event]) -> list[Event]:
    """Return the events with adjacent noise of one reason joined; unknown frames stay whole."""
    whole: list[Event] = []
    for event in events:
        last = whole[-1] if whole else None
        if type(event) is Noise and type(last) is Noise and last.reason is event.reason:
            whole[-1] = Noise(last.data + event.data, event.reason)
        else:
            whole.append(event)
    return whole


def said(message: Message) -> tuple[str, dict[str, Any]]:
    """Return a message as its name and its fields, made of plain lists, dicts and numbers."""
    fields = {name: _plain(getattr(message, name)) for name in message.__match_args__}
    return type(message).__name__, fields


def scanned(events: Iterable[Event]) -> list[tuple[str, dict[str, Any]] | bytes]:
    """Return the events as oracle.scan lists them: noise as bytes, adjacent noise joined."""
    plain: list[tuple[str, dict[str, Any]] | bytes] = []
    for event in events:
        if isinstance(event, Message):
            plain.append(said(event))
        elif plain and isinstance(plain[-1], bytes):
            plain[-1] += event.data
        else:
            plain.append(event.data)
    return plain


def oracles(direction: Direction | None) -> str | None:
    """Return the direction, as the oracle names it."""
    return None if direction is None else direction.value


def _plain(value: Any) -> Any:
    if isinstance(value, int):
        return value
    names = getattr(value, "__match_args__", None)
    return (
        [_plain(item) for item in value] if names is None else dict(zip(names, value, strict=True))
    )


def noise(hex_data: str, reason: Reason) -> Noise:
    return Noise(bytes.fromhex(hex_data), reason)
