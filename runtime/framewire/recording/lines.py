"""Read the lines of a recording: each is one event, with its time, its sender and its bytes."""

from __future__ import annotations

import re
from datetime import datetime

from ..codec.event_bytes import bytes_of
from ..codec.hextext import HexError, read_hex
from ..codec.noise import Noise
from ..frame.errors import Reason
from .ends import ends_of
from .entry import Entry, RecordingError
from .file import EITHER, NOISE
from .form import LONGEST_LINE, TIMED_LINE, LogError

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from typing import Any

    from ..codec.decoder import StreamDecoder
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..frame.message import Message
    from .ends import Ends
    from .form import LogLines

_BEGAN = re.compile(
    r"# recorded of .* from (\d{4}-\d\d-\d\d \d\d:\d\d:\d\d)(\.\d{1,6})? ([+-]\d{4}) on"
)
_REASONS = {reason.value: reason for reason in Reason}


def recorded(
    codec: ProtocolCodec, blocks: Iterable[str], direction: Direction | None
) -> Iterator[Entry]:
    """Yield the entries of a recording; `direction` is of lines that name either end as sender."""
    ends = ends_of(codec)
    began: float | None = None
    number = offset = 0
    for block in blocks:
        lines = block.split("\n")
        if not lines[-1]:
            lines.pop()
        for line in lines:
            number += 1
            found = TIMED_LINE.match(line)
            if found is None or len(line) >= LONGEST_LINE:
                began = _beginning(line, number, began)
                continue
            text, at, who, what = found.groups()
            try:
                data = read_hex(text)
            except HexError as error:
                raise RecordingError(f"line {number}: {error}") from None
            sender, is_noise = _sender(ends, who, number, direction)
            way, time = ends.only[sender], float(at)
            for event in _events(ends, data, sender, what.strip(), is_noise=is_noise):
                yield Entry(
                    event, sender, offset, line=number, time=time, began=began, direction=way
                )
                offset += len(bytes_of(event))


def logged(
    codec: ProtocolCodec, blocks: Iterable[str], lines: LogLines, direction: Direction | None
) -> Iterator[Entry]:
    """Yield the entries of a log, in which what each end sends is one stream.

    TX is what this end sends, and RX what comes to it; `direction` is of lines that name neither.
    """
    ends = ends_of(codec)
    streams: dict[str, tuple[StreamDecoder, str | None]] = {}
    offset = 0
    number = 0
    at: float | None = None
    for block in blocks:
        for line in block.removesuffix("\n").split("\n"):
            number += 1
            for text, at, way in _logged_line(lines, line, number):
                try:
                    data = read_hex(text)
                except HexError as error:
                    raise RecordingError(f"line {number}: {error}") from None
                if way not in streams:
                    streams[way] = _stream_of(ends, way, direction)
                stream, who = streams[way]
                for event in stream.feed(data):
                    yield _of_stream(ends, event, who, offset, number, at)
                    offset += len(bytes_of(event))
    for stream, who in streams.values():
        for event in stream.flush():
            yield _of_stream(ends, event, who, offset, number, at)
            offset += len(bytes_of(event))


def _of_stream(
    ends: Ends, event: Message | Noise, who: str | None, offset: int, line: int, at: float | None
) -> Entry:
    """Return an entry of a stream of which `who` alone is known to send it, None for either."""
    sender = who or sender_of(ends.codec, event)
    return Entry(event, sender, offset, line=line, time=at, direction=ends.only[sender])


def _logged_line(lines: LogLines, line: str, number: int) -> list[tuple[str, float | None, str]]:
    try:
        return lines.read(line)
    except LogError as error:
        raise RecordingError(f"line {number}: {error}") from None


def _stream_of(
    ends: Ends, way: str, direction: Direction | None
) -> tuple[StreamDecoder, str | None]:
    """Return a decoder of what goes one way, and who sends it, None for either."""
    codec = ends.codec
    who = {"tx": codec.received.receiver, "rx": codec.received.sender}.get(way)
    if who is None:
        return codec.decoder(direction), None if direction is None else direction.sender
    return codec.decoder(ends.only[who]), who


def sender_of(codec: ProtocolCodec, event: Message | Noise) -> str | None:
    """Return who alone sends such an event; None for noise, and for what either end may send."""
    return None if isinstance(event, Noise) or codec.twins(event) else event.DIRECTION.sender


def _beginning(line: str, number: int, began: float | None) -> float | None:
    """Return when the recording began, or None. Raises RecordingError if the line has bytes."""
    line = line.strip()
    if len(line) >= LONGEST_LINE:
        problem = f"it has more than {LONGEST_LINE} characters, and is no line of a recording"
        raise RecordingError(f"line {number}: {problem}")
    if line and not line.startswith("#"):
        raise RecordingError(
            f"line {number}: it has no time and sender, as in `HEX  # 0.5 s, NAME: ...`, "
            "and other lines have"
        )
    found = _BEGAN.fullmatch(line)
    if found is None:
        return began
    day, part, zone = found.groups()
    try:
        return datetime.strptime(f"{day} {zone}", "%Y-%m-%d %H:%M:%S %z").timestamp() + float(
            part or 0
        )
    except ValueError:  # the 31st of February
        return began


def _sender(
    ends: Ends, who: str, number: int, direction: Direction | None
) -> tuple[str | None, bool]:
    """Return who sent a line, None for either, and whether it was noise. Raises RecordingError."""
    whose, _, last = who.rpartition(" ")
    if is_noise := last == NOISE:
        # A line without a sender came to this end: what a client sends is never noise.
        who = whose or ends.codec.received.sender
    if who in ends.ways:
        return who, is_noise
    if who == EITHER:
        return (None if direction is None else direction.sender), is_noise
    known = ", ".join([*ends.ways, EITHER, NOISE])
    raise RecordingError(f"line {number}: {who!r} is none of those who send: {known}")


def _events(
    ends: Ends, data: bytes, sender: str | None, what: str, *, is_noise: bool
) -> list[Message | Noise]:
    """Return the events of a line's bytes, as its sender's: one, or more if lines were joined.

    Bytes recorded as noise stay noise, even if they would be a message by themselves; save for a
    frame whose command was not known then.
    """
    ways: Sequence[Direction | None] = [None] if sender is None else ends.ways[sender]
    codec = ends.codec
    for way in () if is_noise else ways:
        message: Any = codec.table_for(way).find(data)
        if message is not None:
            return [message]
    # Of several ends that it may have been sent to, to the one that understands most of it.
    events = min((_streamed(codec, data, way) for way in ways), key=_noise_in)
    if not is_noise:
        return events
    reason = _REASONS.get(what)
    if reason is Reason.UNKNOWN_COMMAND and len(events) == 1 and type(events[0]) is not Noise:
        return events
    reasons = [event.reason for event in events if isinstance(event, Noise)]
    return [Noise(data, reason or (reasons or [Reason.BAD_HEADER])[0])] if data else []


def _streamed(
    codec: ProtocolCodec, data: bytes, direction: Direction | None
) -> list[Message | Noise]:
    decoder = codec.decoder(direction)
    return [*decoder.feed(data), *decoder.flush()]


def _noise_in(events: Iterable[Message | Noise]) -> int:
    return sum(len(event.data) for event in events if isinstance(event, Noise))
