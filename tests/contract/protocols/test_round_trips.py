"""A message reads as itself, also where its first bytes are a whole frame of another."""

from __future__ import annotations

import pytest
from framegen.cases.lengthened import lengthened
from framegen.model.apart import begun
from framegen.model.codec import decode, encode
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.protocols.libraries import Libraries, direction_of, made_of, values_in
from tests.protocols.specs import FILES, messages_of, model_of, values_of
from tests.protocols.streams import LARGE
from tests.rows import each_protocol

# The protocols with messages that only a checksum tells from the beginning of a longer one.
BY_CHANCE = ["roboclaw", "gauges"]


def test_the_protocols_in_which_frames_begin_alike_are_known() -> None:
    assert [name for name in FILES if [*begun(model_of(name))]] == BY_CHANCE


@pytest.mark.parametrize("name", each_protocol(FILES))
@in_turn("message", messages_of)
@few_each
@given(data=st.data())
def test_what_is_written_is_read(
    libraries: Libraries, name: str, message: str, data: st.DataObject
) -> None:
    made, layout = libraries[name], messages_of(name)[message]
    values = data.draw(values_of(name, message))
    frame = encode(layout, values)
    assert made_of(made, layout, values).encode() == frame
    there = made.decode(frame, direction_of(made, layout.direction))
    assert (type(there).__name__, values_in(layout, there)) == (message, values)
    here = decode(model_of(name), layout.direction, frame)
    assert (here.layout.name, here.values) == (message, values)
    if len(frame) <= LARGE:
        assert read_by_reference(name, message, [frame, None]) == [(message, frame)]


@pytest.mark.parametrize("name", BY_CHANCE)
def test_a_frame_that_begins_as_another_reads_as_itself(libraries: Libraries, name: str) -> None:
    made, found = libraries[name], [*lengthened(model_of(name))]
    assert found
    for each in found:
        way, kind = direction_of(made, each.long.direction), getattr(made, each.long.name)
        assert type(made.decode(each.data, way)) is kind
        assert type(made.decode(each.beginning, way)) is getattr(made, each.short.name)
        for cut in range(len(each.data)):
            decoder = made.StreamDecoder(way)
            events = [*decoder.feed(each.data[:cut]), *decoder.feed(each.data[cut:])]
            assert [*map(type, [*events, *decoder.flush()])] == [kind]


def test_every_pressure_that_begins_with_a_fault_reads_as_itself(libraries: Libraries) -> None:
    made = libraries["gauges"]
    way = made.Direction.GAUGE_TO_PANEL
    for high in range(0x100):
        pressure = made.Pressure(high << 8 | (0x21 + high) & 0xFF)
        frame = pressure.encode()
        assert frame[:3] == made.Fault(high).encode()
        assert made.decode(frame, way) == pressure
        assert made.StreamDecoder(way).feed(frame) == [pressure]
        parts = [frame[:3], frame[3:]]
        assert read_by_reference("gauges", "Pressure", [*parts]) == [("Pressure", frame)]


def test_a_fault_waits_for_what_follows(libraries: Libraries) -> None:
    made = libraries["gauges"]
    decoder = made.StreamDecoder(made.Direction.GAUGE_TO_PANEL)
    fault = made.Fault(3)
    assert decoder.feed(fault.encode()) == []
    assert (decoder.pending, decoder.missing) == (3, 1)
    assert decoder.flush() == [fault]
    assert decoder.feed(fault.encode() * 2) == [fault]
    assert decoder.feed(fault.encode()[:1]) == [fault]


def test_no_longer_frame_is_awaited_than_there_is_room_for(libraries: Libraries) -> None:
    made = libraries["gauges"]
    decoder = made.StreamDecoder(made.Direction.GAUGE_TO_PANEL, max_frame=3)
    assert decoder.feed(made.Fault(3).encode()) == [made.Fault(3)]


def read_by_reference(
    name: str, message: str, parts: list[bytes | None]
) -> list[tuple[str, bytes]]:
    """Return what the reference finds on a line that carries what goes the way of a message."""
    way = messages_of(name)[message].direction
    events = ReferenceDecoder(model_of(name), [way]).follow(parts)
    return [
        (event.message.name if event.message else event.kind, event.data)
        for event in events
        if event is not None
    ]
