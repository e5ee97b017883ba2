"""The reference decoder on lines of every protocol: garbage, cuts and false headers."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import pytest
from framegen.model.stream import Event, ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.protocols.specs import model_of
from tests.protocols.streams import all_ways, frames, lines, noise, proven, published, told_apart
from tests.rows import each_protocol

if TYPE_CHECKING:
    from framegen.language.values import Direction

ALL_WAYS = [pytest.param(*each, id=f"{each[0]}-{each[1].sender}") for each in all_ways()]
WAYS = each_protocol(ALL_WAYS)
PROVEN = each_protocol([each for each in ALL_WAYS if proven(str(each.values[0]))])


def decoder(name: str, way: Direction) -> ReferenceDecoder:
    return ReferenceDecoder(model_of(name), [way])


def overlapping(events: list[Event], at: int, size: int) -> list[Event]:
    """Return the frames that share bytes with a stretch."""
    return [
        event
        for event in events
        if event.kind != "noise" and event.at < at + size and at < event.at + len(event.data)
    ]


@pytest.mark.parametrize(("name", "way"), WAYS)
@few_each
@given(data=st.data())
def test_1_2_nothing_is_lost_and_what_is_certain_stands_whatever_follows(
    name: str, way: Direction, data: st.DataObject
) -> None:
    line = data.draw(lines(name, way))
    cut = data.draw(st.integers(0, len(line)))
    reference = decoder(name, way)
    assert b"".join(event.data for event in reference.decode(line)) == line
    certain = [event for event in reference.decode_so_far(line[:cut]) if event.kind != "noise"]
    whole = [event for event in reference.decode_so_far(line) if event.kind != "noise"]
    assert whole[: len(certain)] == certain


@pytest.mark.parametrize(("name", "way"), WAYS)
@few_each
@given(data=st.data())
def test_3_a_frame_behind_garbage_is_lost_to_another_frame_alone(
    name: str, way: Direction, data: st.DataObject
) -> None:
    garbage, frame = data.draw(noise(name, way)), data.draw(frames(name, way))
    events = decoder(name, way).decode(garbage + frame)
    found = overlapping(events, len(garbage), len(frame))
    assert [event.data for event in found] == [frame] or found[0].at < len(garbage)


@pytest.mark.parametrize(("name", "way"), WAYS)
@few_each
@given(data=st.data())
def test_3_frames_behind_each_other_are_all_found(
    name: str, way: Direction, data: st.DataObject
) -> None:
    sent = data.draw(st.lists(frames(name, way), max_size=4))
    # What only a checksum tells from the beginning of another is ended by silence.
    lines = [b"".join(sent)] if told_apart(name, way) else sent
    events = [event for line in lines for event in decoder(name, way).decode(line)]
    assert [(event.kind, event.data) for event in events] == [("message", each) for each in sent]


@pytest.mark.parametrize(("name", "way"), PROVEN)
def test_3_a_frame_that_is_cut_off_costs_the_next_nothing(name: str, way: Direction) -> None:
    reference = decoder(name, way)
    tried, lost = 0, []
    for cut_off, frame in pairwise([*published(name, way), *published(name, way)[:2]]):
        for size in range(1, len(cut_off)):
            found = overlapping(reference.decode(cut_off[:size] + frame), size, len(frame))
            tried += 1
            if [event.data for event in found] != [frame]:
                # Eight bits take one in 256 for a frame, and `xor` what stands there twice.
                assert found[0].at < size
                lost.append(cut_off[:size].hex(" "))
    assert len(lost) <= 1 + tried // 8


@pytest.mark.parametrize(("name", "way"), WAYS)
def test_4_at_most_the_largest_frame_is_held(name: str, way: Direction) -> None:
    reference = decoder(name, way)
    largest = reference.model.largest([way])
    for frame in published(name, way):
        for size in range(1, len(frame)):
            line = frame[:size] * 3
            held = len(line) - sum(len(event.data) for event in reference.decode_so_far(line))
            assert held <= largest


@pytest.mark.parametrize(("name", "way"), PROVEN)
def test_a_changed_bit_is_noticed(name: str, way: Direction) -> None:
    reference = decoder(name, way)
    for frame in published(name, way):
        for at in range(len(frame)):
            spoilt = frame[:at] + bytes([frame[at] ^ 0x10]) + frame[at + 1 :]
            assert spoilt not in [
                event.data for event in reference.decode(spoilt) if event.kind == "message"
            ]
