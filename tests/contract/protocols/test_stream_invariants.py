"""The stream decoders of libraries: what they promise, also against lines made to cost much."""

from collections.abc import Sequence
from copy import copy
from itertools import pairwise
from typing import Any

import pytest
from framegen.language.values import Direction
from framegen.model.layout import MessageLayout
from framegen.model.slots import Constant, Number
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES, model_of
from tests.protocols.streams import all_ways, lines, read_by_reference, told
from tests.rows import each_protocol, some
from tests.strategies import pieces
from tests.unit.runtime.codec.test_stream import calls

EACH_WAY = [pytest.param(*each, id=f"{each[0]}-{each[1].sender}") for each in all_ways()]
each_name = pytest.mark.parametrize("name", each_protocol(FILES))
# What costs most is counted in every run where lengths are claimed, and where nothing but a sum
# tells frames: these are searched in the ways that there are.
COUNTED = {"everything", "gauges", "lxservo", "modbus"}
each_counted = pytest.mark.parametrize(
    ("name", "way"), some(EACH_WAY, lambda name, _way: name in COUNTED)
)


def drawn_line(data: st.DataObject, name: str) -> bytes:
    """Return what a line carries on which every end sends."""
    ways = [way for each, way in all_ways() if each == name]
    parts = [data.draw(lines(name, data.draw(st.sampled_from(ways)))) for _ in range(2)]
    return b"".join(parts)[:300]


@each_name
@few_each
@given(data=st.data())
def test_messages_come_as_soon_as_they_are_certain(
    libraries: Libraries, name: str, data: st.DataObject
) -> None:
    made, model = libraries[name], model_of(name)
    ways = data.draw(st.sampled_from([[way] for way in model.directions] + [model.directions]))
    largest, least = model.largest(ways), min(each.least for each in model.envelopes.values())
    max_frame = data.draw(st.none() | st.integers(least, max(least, min(largest, 60))))
    direction = direction_of(made, ways[0]) if len(ways) == 1 else None
    decoder = made.StreamDecoder(direction, max_frame)
    reference = ReferenceDecoder(model, ways, max_frame)
    # From quiet to quiet.
    for stretch in [drawn_line(data, name), drawn_line(data, name)]:
        events: list[Any] = []
        for chunk in data.draw(pieces(stretch)):
            events += decoder.feed(chunk)
            assert decoder.pending < max(1, min(largest, max_frame or largest))
        assert [(kind, data) for kind, data, _ in told(made, events) if kind[0].isupper()] == [
            (event.message.name, event.data)
            for event in reference.decode_so_far(stretch)
            if event.message
        ]
        events += decoder.flush()
        assert told(made, events) == read_by_reference(reference, stretch)
        assert decoder.pending == 0


# So many calls of functions does a byte cost at most, whatever it is. Where nothing tells a frame
# but its checksum, each byte may be the first of several messages, and costs as much for each.
CALLS_PER_BYTE = 400
# The first is more than most lines hold; the last step is twice the one before it.
SIZES = (512, 768, 1280)


def longest_head(message: MessageLayout) -> bytes:
    """Return the head of the largest frame of a message, up to the count of its list."""
    count = message.counts[-1]
    frame = bytearray(message.size_at(count))
    end = message.frame.body_at
    for placed in message.lay_out(count):
        slot = placed.slot
        if isinstance(slot, Constant):
            frame[placed.at : placed.end] = slot.data
        elif not isinstance(slot, Number):
            continue
        elif slot.role == "length":
            frame[placed.at : placed.end] = slot.write(message.formula.at(count))
        elif slot.role == "id":
            frame[placed.at : placed.end] = slot.write(message.id_of(slot))
        elif slot.role == "address":
            frame[placed.at : placed.end] = slot.write(slot.low)
        elif slot.role in ("count", "size") and message.items is not None:
            frame[placed.at : placed.end] = slot.write(message.items.counted(slot, count))
            end = placed.end
    return bytes(frame[:end])


def hostile(name: str, way: Direction) -> list[bytes]:
    """Return beginnings that claim as much as they can, to be repeated."""
    sent = sorted(model_of(name).sent(way), key=lambda message: message.largest)
    heads = [longest_head(sent[0]), longest_head(sent[-1])]
    return [*heads, heads[1] + b"\1", heads[1][:1], b"\1", heads[0] + heads[1][:2]]


@each_counted
@in_turn("size", lambda: [1, SIZES[-1]])
def test_hostile_lines_cost_linear_time_however_they_come(
    libraries: Libraries, name: str, way: Direction, size: int
) -> None:
    made = libraries[name]

    def read(decoder: Any, line: bytes) -> None:
        for at in range(0, len(line), size):
            decoder.feed(line[at : at + size])

    for pattern in filter(None, hostile(name, way)):
        line = pattern * (SIZES[-1] // len(pattern) + 1)
        # What is looked up once for all is none of it.
        warm = made.StreamDecoder(direction_of(made, way))
        read(warm, line[:64])
        warm.flush()
        decoder, spent, costs = made.StreamDecoder(direction_of(made, way)), 0, []
        for begin, end in pairwise([0, *SIZES]):
            spent += calls(lambda: read(decoder, line[begin:end]))  # noqa: B023
            costs.append(spent + calls(copy(decoder).flush))
        assert_linear(name, way, costs, pattern)


def assert_linear(name: str, way: Direction, costs: Sequence[int], pattern: bytes) -> None:
    """See that lines of SIZES cost no more than each byte may, and later bytes no more."""
    rivals = max(1, sum(not each.frame.body_at for each in model_of(name).sent(way)))
    few, more, most = costs
    assert most <= CALLS_PER_BYTE * rivals * SIZES[-1], pattern.hex(" ")
    assert most - more <= 2.2 * (more - few) + 20 * 256, pattern.hex(" ")


@each_name
def test_a_sum_proves_what_a_length_only_claims(libraries: Libraries, name: str) -> None:
    """A frame of an id that nobody knows is taken whole where its checksum is right."""
    made, model = libraries[name], model_of(name)
    for way in model.directions:
        known = {message.ids for message in model.sent(way)}
        frames = {message.frame.name: message.frame for message in model.sent(way)}
        for frame in (each for each in frames.values() if each.proves_unknown and each.ids):
            code = next(n for n in range(255, -1, -1) if (n,) * len(frame.ids) not in known)
            data = bytearray(frame.least)
            for placed in frame.lay_out(frame.least):
                slot = placed.slot
                if isinstance(slot, Constant):
                    data[placed.at : placed.end] = slot.data
                elif isinstance(slot, Number) and slot.role in ("id", "length", "address"):
                    due = {"id": code, "length": frame.least - frame.uncounted}
                    number = due.get(slot.role, max(slot.low, 1))
                    data[placed.at : placed.end] = slot.write(number)
            unknown = frame.sealed(bytes(data), {})
            decoder = made.StreamDecoder(direction_of(made, way))
            (event,) = decoder.feed(unknown)
            assert type(event) is made.UnknownFrame
            assert (event.data, event.ids) == (unknown, (code,) * len(frame.ids))
            assert event.parameters == b""
