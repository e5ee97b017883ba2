"""Every library says of any bytes, in any pieces, what the reference says."""

from __future__ import annotations

import importlib
from contextlib import ExitStack
from itertools import pairwise
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest
from framegen.model.codec import NotAFrame, decode
from framegen.model.slots import Body, Constant, Number
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.specimens import BUSSERVO, DEMO, data_of, files_of, layout_of, library

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.language.values import Direction
    from framegen.model.model import Model
    from framegen.model.slots import Placed

# What was found on a line: the name of a message, or the reason why it is none, and its bytes.
Found: TypeAlias = tuple[str, bytes]

SPECS = {
    data["protocol"]["name"]: data
    for data in map(data_of, [BUSSERVO, DEMO, *sorted(DEMO.parent.glob("*.yaml"))])
}
MODELS = {name: layout_of(data) for name, data in SPECS.items()}


@pytest.fixture(scope="module", autouse=True)
def libraries(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """All of them, imported under their own names."""
    with ExitStack() as stack:
        for name, data in SPECS.items():
            if name != "busservo":
                folder = tmp_path_factory.mktemp(name)
                stack.enter_context(library(files_of(data), folder))
        yield


def lib(name: str) -> Any:
    """A library, for Hypothesis, which takes no fixtures."""
    return importlib.import_module(name)


# --- Lines ---------------------------------------------------------------------------------------


def number(draw: st.DrawFn, placed: Placed, header: bytes) -> bytes:
    """The bytes of a number: often the ends of its range, or what looks like a header."""
    slot = placed.slot
    assert isinstance(slot, Number)
    if draw(st.integers(0, 3)) == 0:
        return (header * slot.size)[: slot.size]
    value = draw(st.sampled_from([slot.low, slot.high]) | st.integers(slot.low, slot.high))
    return slot.write(value)


@st.composite
def frames(draw: st.DrawFn, model: Model) -> bytes:
    """A frame of any message, most often with legal values."""
    messages = [each for way in model.directions for each in model.sent(way).values()]
    message = draw(st.sampled_from(messages))
    counts = message.counts
    count = draw(st.sampled_from([*counts[:4], counts[-1]]))
    data = bytearray(message.size_at(count))
    for placed in message.lay_out(count):
        slot = placed.slot
        assert not isinstance(slot, Body)
        if isinstance(slot, Constant):
            written = slot.data
        elif slot.role == "length":
            written = slot.write(message.formula.at(count))
        elif slot.role == "id":
            written = slot.write(message.id)
        elif slot.role == "count":
            written = slot.write(count)
        else:
            written = number(draw, placed, model.frame.header)
        data[placed.at : placed.end] = written
    return bytes(data)


@st.composite
def damaged(draw: st.DrawFn, model: Model) -> bytes:
    """A frame of which something was lost, changed or repeated."""
    frame = draw(frames(model))
    start = draw(st.integers(0, min(8, len(frame)) - 1) | st.integers(0, len(frame) - 1))
    end = draw(st.integers(start, min(start + 3, len(frame))) | st.just(len(frame)))
    return frame[:start] + draw(st.binary(max_size=3)) + frame[end:]


@st.composite
def heads(draw: st.DrawFn, model: Model) -> bytes:
    """A header, and most often a length and an id, none of which need be legal."""
    frame = model.frame
    largest = model.largest(model.directions)
    head = bytearray(frame.header.ljust(frame.body_at, b"\0"))
    sizes = st.integers(frame.least - 1, frame.least + 12) | st.just(largest)
    length = min(max(draw(sizes) - frame.uncounted, 0), frame.length.high)
    known = [each for way in model.directions for each in model.sent(way)]
    code = draw(st.sampled_from(known) | st.integers(frame.id.low, frame.id.high))
    for slot, value in ((frame.length, length), (frame.id, code)):
        head[slot.at : slot.at + slot.size] = slot.write(value)
    return bytes(head[: draw(st.integers(1, len(head)) | st.just(len(head)))])


@st.composite
def lines(draw: st.DrawFn, model: Model) -> bytes:
    """Frames, frames of unknown id, and what is left of them, one behind the other."""
    header = model.frame.header
    likely = st.sampled_from([*header, *header, 0, 1, 2, 3, 4, 5, 6, 7, 8, 0x63, 0xFF])
    part = st.one_of(
        frames(model),
        damaged(model),
        heads(model),
        st.tuples(heads(model), st.binary(max_size=10)).map(b"".join),
        st.integers(1, 100).map(lambda size: header[:1] * size),
        st.lists(likely, max_size=8).map(bytes),
        st.just(header),
        st.binary(max_size=4),
    )
    return b"".join(draw(st.lists(part, max_size=7)))[:400]


def pieces(draw: st.DrawFn, line: bytes) -> list[bytes]:
    """The line, cut anywhere, also into single bytes."""
    if draw(st.booleans()):
        return [line[at : at + 1] for at in range(len(line))]
    cuts = sorted(draw(st.lists(st.integers(0, len(line)), max_size=8)))
    return [line[start:end] for start, end in pairwise([0, *cuts, len(line)])]


@st.composite
def ways(draw: st.DrawFn, model: Model) -> Sequence[Direction]:
    """One direction, or all of them."""
    return draw(st.sampled_from([[way] for way in model.directions] + [list(model.directions)]))


# --- What was found ------------------------------------------------------------------------------


def told(events: Sequence[Any], name: str) -> list[Found]:
    """What a library tells, noise joined."""
    library = lib(name)
    found: list[Found] = []
    last: Any = None
    for event in events:
        if isinstance(event, library.Message):
            found.append((type(event).__name__, event.encode()))
        elif type(event) is library.UnknownFrame:
            found.append(("unknown frame", event.data))
        elif type(last) is library.Noise and last.reason is event.reason:
            found[-1] = (found[-1][0], found[-1][1] + event.data)
        else:
            found.append((event.reason.value, event.data))
        last = event
    return found


def expected(line: ReferenceDecoder, stretch: bytes) -> list[Found]:
    """What the reference tells of a stretch of a line, behind which that is quiet."""
    names = {"unknown": "unknown frame"}
    return [
        (event.message.name if event.message else names.get(event.kind, event.reason), event.data)
        for event in line.decode(stretch)
    ]


def way_of(name: str, directions: Sequence[Direction]) -> Any:
    """The directions as a library takes them."""
    return lib(name).Direction(directions[0].key) if len(directions) == 1 else None


each_spec = pytest.mark.parametrize("name", SPECS)


@each_spec
@given(data=st.data())
def test_a_stream_decoder_tells_what_the_reference_tells(name: str, data: st.DataObject) -> None:
    model = MODELS[name]
    directions = data.draw(ways(model))
    largest = model.largest(directions)
    max_frame = data.draw(st.none() | st.integers(model.frame.least, largest + 2))
    decoder = lib(name).StreamDecoder(way_of(name, directions), max_frame)
    line = ReferenceDecoder(model, directions, max_frame)
    # From quiet to quiet.
    for stretch in data.draw(st.lists(lines(model), min_size=1, max_size=3)):
        chunks = data.draw(st.composite(pieces)(stretch))
        events = []
        for chunk in chunks:
            events += decoder.feed(chunk)
            assert decoder.pending < min(largest, max_frame or largest)
        assert messages(told(events, name)) == messages(
            [
                (event.message.name, event.data)
                for event in line.decode_so_far(stretch)
                if event.message
            ]
        )
        assert told(events + decoder.flush(), name) == expected(line, stretch)


def messages(found: list[Found]) -> list[Found]:
    """The messages among what was found."""
    return [each for each in found if each[0][0].isupper()]


@each_spec
@given(data=st.data())
def test_decode_gives_the_reason_and_the_offset_of_the_reference(
    name: str, data: st.DataObject
) -> None:
    model = MODELS[name]
    directions = data.draw(ways(model))
    frame = data.draw(lines(model) | frames(model) | damaged(model))
    wanted: object
    try:
        wanted = decode(model, directions[0] if len(directions) == 1 else None, frame).layout.name
    except NotAFrame as error:
        wanted = (error.reason, error.offset)
    found: object
    try:
        found = type(lib(name).decode(frame, way_of(name, directions))).__name__
    except lib(name).DecodeError as error:
        found = (error.reason.value, error.offset)
    assert found == wanted
