"""Lines of any protocol: its frames, damaged and cut off ones, and noise that looks like them."""

from collections.abc import Iterable
from functools import cache, partial
from typing import Any, TypeAlias

from framegen.cases.lengthened import lengthened
from framegen.language.values import Direction
from framegen.model.codec import encode
from framegen.model.layout import MessageLayout
from framegen.model.stream import ReferenceDecoder
from hypothesis import strategies as st

from tests.protocols.specs import FILES, messages_of, model_of, values_of

# What was found on a line: what it is, its bytes, and why it is no message.
Told: TypeAlias = tuple[str, bytes, str]
# A frame that is larger makes a line slow to judge, and says nothing that a smaller does not.
LARGE = 100


def sent(name: str, way: Direction) -> list[MessageLayout]:
    """Return the messages that go one way."""
    return [message for message in messages_of(name).values() if message.direction == way]


@cache
def frames(name: str, way: Direction) -> st.SearchStrategy[bytes]:
    """Return a strategy for frames of one direction."""
    drawn = [
        values_of(name, message.name, few=True).map(partial(encode, message))
        for message in sent(name, way)
    ]
    small = st.one_of(drawn).filter(lambda frame: len(frame) <= LARGE)
    longer = [each.data for each in lengthened(model_of(name)) if each.long.direction == way]
    return st.sampled_from([*published(name, way), *longer]) | small


@cache
def published(name: str, way: Direction) -> list[bytes]:
    """Return the frames of the examples of one direction."""
    found = [each.hex for message in sent(name, way) for each in message.message.examples]
    return [frame for frame in found if len(frame) <= LARGE]


@cache
def noise(name: str, way: Direction) -> st.SearchStrategy[bytes]:
    """Return a strategy for what is likely to be taken for the beginning of a frame."""
    heads = [frame[:size] for frame in published(name, way) for size in (1, 2, 4, 5, 7)]
    near = st.sampled_from([*{byte for head in heads for byte in head}, 0, 1, 2, 0xFF])
    return st.sampled_from(heads) | st.lists(near, max_size=8).map(bytes) | st.binary(max_size=4)


@st.composite
def _damaged(draw: st.DrawFn, frame: bytes) -> bytes:
    """Return a frame with bytes lost, changed or added."""
    start = draw(st.integers(0, len(frame) - 1))
    end = draw(st.integers(start, min(start + 3, len(frame))))
    return frame[:start] + draw(st.binary(max_size=2)) + frame[end:]


@cache
def lines(name: str, way: Direction) -> st.SearchStrategy[bytes]:
    """Return a strategy for what a line may carry."""
    frame = frames(name, way)
    pieces = st.one_of(frame, frame.flatmap(_damaged), noise(name, way))
    return st.lists(pieces, max_size=5).map(b"".join)


def all_ways() -> list[tuple[str, Direction]]:
    """Return the directions of all protocols."""
    return [(name, way) for name in FILES for way in model_of(name).directions if sent(name, way)]


def reported(made: Any, event: Any) -> Told:
    """Return what the decoder of a library found: what it is, its bytes, and why it is none."""
    if isinstance(event, made.Message):
        return type(event).__name__, event.encode(), ""
    kind = "unknown" if isinstance(event, made.UnknownFrame) else "noise"
    return kind, event.data, event.reason.value


def joined(events: Iterable[Told]) -> list[Told]:
    """Return events with neighbouring noise of one reason joined."""
    whole: list[Told] = []
    for kind, data, reason in events:
        if whole and kind == "noise" and whole[-1][0] == "noise" and whole[-1][2] == reason:
            whole[-1] = kind, whole[-1][1] + data, reason
        else:
            whole.append((kind, data, reason))
    return whole


def told(made: Any, events: Iterable[Any]) -> list[Told]:
    """Return what the decoder of a library finds."""
    return joined(reported(made, event) for event in events)


def read_by_reference(line: ReferenceDecoder, stretch: bytes) -> list[Told]:
    """Return what the reference finds on a line that is quiet then."""
    return joined(
        (
            event.message.name if event.message else event.kind,
            event.data,
            "" if event.message else event.reason,
        )
        for event in line.decode(stretch)
    )
