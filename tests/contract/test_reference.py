"""Every library decodes any bytes, in any pieces, as the reference does."""

from __future__ import annotations

import importlib
from functools import cache
from itertools import cycle
from typing import TYPE_CHECKING, Any

import pytest
from framegen.model.codec import NotAFrame, decode
from framegen.model.slots import Constant, Number
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, data_of, files_of, imported, layout_of
from tests.few_each import few_each
from tests.protocols.streams import read_by_reference, told
from tests.strategies import pieces

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

SPECS = {
    data["protocol"]["name"]: data
    for data in map(data_of, [BUSSERVO, DEMO, *sorted(DEMO.parent.glob("*.yaml"))])
}


def has_plain_frames(model: Model) -> bool:
    """Tell whether all frames have a header, a length and an id, and nothing behind the fields."""
    if len(model.envelopes) > 1:
        return False
    roles = sorted(slot.role for slot in model.frame.head)
    return roles == ["constant", "id", "length"] and not model.frame.tail


# Frames of other kinds are held to the reference in tests/protocols.
MODELS = {name: model for name, data in SPECS.items() if has_plain_frames(model := layout_of(data))}
SPECS = {name: SPECS[name] for name in MODELS}


@pytest.fixture(scope="module", autouse=True)
def libraries() -> Iterator[None]:
    """Return all of them, imported under their own names."""
    with imported(*(files_of(data) for name, data in SPECS.items() if name != "busservo")):
        yield


def lib(name: str) -> Any:
    """Return a library, for Hypothesis, which takes no fixtures."""
    return importlib.import_module(name)


# --- Lines ---------------------------------------------------------------------------------------


# What to draw from is worked out once: in each draw, that would take longer than all else.


@cache
def values(low: int, high: int) -> st.SearchStrategy[list[int | None]]:
    """Return some numbers, often the ends of their range; None for one that looks like a header."""
    value = st.one_of(st.none(), st.sampled_from([low, high]), st.integers(low, high))
    return st.lists(value, min_size=1, max_size=5)


@cache
def frames(model: Model) -> st.SearchStrategy[bytes]:
    """Return a frame of any message, most often with legal values."""
    messages = [each for way in model.directions for each in model.sent(way)]
    shapes = [(each, count) for each in messages for count in (*each.counts[:4], each.counts[-1])]
    return st.sampled_from(shapes).flatmap(lambda shape: frame_of(model, *shape))


@st.composite
def frame_of(draw: st.DrawFn, model: Model, message: MessageLayout, count: int) -> bytes:
    """Return a frame of a message with so many elements, of which long lists repeat the first."""
    data = bytearray(message.size_at(count))
    numbers: dict[str, Iterator[int | None]] = {}
    for placed in message.lay_out(count):
        slot = placed.slot
        if isinstance(slot, Constant):
            data[placed.at : placed.end] = slot.data
            continue
        assert isinstance(slot, Number)
        if slot.role == "length":
            written = slot.write(message.formula.at(count))
        elif slot.role == "id":
            written = slot.write(message.id)
        elif slot.role == "count":
            written = slot.write(count)
        else:
            if slot.name not in numbers:
                numbers[slot.name] = cycle(draw(values(slot.low, slot.high)))
            value = next(numbers[slot.name])
            alike = (model.frame.header * slot.size)[: slot.size]
            written = alike if value is None else slot.write(value)
        data[placed.at : placed.end] = written
    return bytes(data)


@st.composite
def damaged(draw: st.DrawFn, model: Model) -> bytes:
    """Return a frame with bytes lost, changed or repeated."""
    frame = draw(frames(model))
    start = draw(st.integers(0, min(8, len(frame)) - 1) | st.integers(0, len(frame) - 1))
    end = draw(st.integers(start, min(start + 3, len(frame))) | st.just(len(frame)))
    return frame[:start] + draw(st.binary(max_size=3)) + frame[end:]


@cache
def heads(model: Model) -> st.SearchStrategy[bytes]:
    """Return a header, and most often a length and an id, none of which need be legal."""
    frame = model.frame
    largest = model.largest(model.directions)
    sizes = st.integers(frame.least - 1, frame.least + 12) | st.just(largest)
    known = [each.id for way in model.directions for each in model.sent(way)]
    codes = st.sampled_from(known) | st.integers(frame.id.low, frame.id.high)
    ends = st.integers(1, frame.body_at) | st.just(frame.body_at)

    def head(size: int, code: int, end: int) -> bytes:
        data = bytearray(frame.header.ljust(frame.body_at, b"\0"))
        length = min(max(size - frame.uncounted, 0), frame.length.high)
        for slot, value in ((frame.length, length), (frame.id, code)):
            data[slot.at : slot.at + slot.size] = slot.write(value)
        return bytes(data[:end])

    return st.builds(head, sizes, codes, ends)


@cache
def lines(model: Model) -> st.SearchStrategy[bytes]:
    """Return frames, frames of unknown id, and parts of them, one behind the other."""
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
    return st.lists(part, max_size=7).map(lambda parts: b"".join(parts)[:400])


@st.composite
def ways(draw: st.DrawFn, model: Model) -> Sequence[Direction]:
    """Return one direction, or all of them."""
    return draw(st.sampled_from([[way] for way in model.directions] + [list(model.directions)]))


# --- What was found ------------------------------------------------------------------------------


def way_of(name: str, directions: Sequence[Direction]) -> Any:
    """Return the directions as a library takes them."""
    return lib(name).Direction(directions[0].key) if len(directions) == 1 else None


each_spec = pytest.mark.parametrize("name", SPECS)


@each_spec
@few_each
@given(data=st.data())
def test_a_stream_decoder_agrees_with_the_reference(name: str, data: st.DataObject) -> None:
    model = MODELS[name]
    directions = data.draw(ways(model))
    largest = model.largest(directions)
    max_frame = data.draw(st.none() | st.integers(model.frame.least, largest + 2))
    decoder = lib(name).StreamDecoder(way_of(name, directions), max_frame)
    line = ReferenceDecoder(model, directions, max_frame)
    # From quiet to quiet.
    for stretch in data.draw(st.lists(lines(model), min_size=1, max_size=3)):
        chunks = data.draw(pieces(stretch))
        events = []
        for chunk in chunks:
            events += decoder.feed(chunk)
            assert decoder.pending < min(largest, max_frame or largest)
        assert [each[:2] for each in told(lib(name), events) if each[0][0].isupper()] == [
            (event.message.name, event.data)
            for event in line.decode_so_far(stretch)
            if event.message
        ]
        assert told(lib(name), events + decoder.flush()) == read_by_reference(line, stretch)


@each_spec
@few_each
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
