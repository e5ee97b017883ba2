"""The generated libraries: the same frames, values and refusals as the reference."""

import doctest
from collections.abc import Callable
from importlib import import_module
from typing import Any

import pytest
from framegen.cases.lengthened import lengthened
from framegen.language.values import Direction
from framegen.model.apart import begun
from framegen.model.codec import NotAFrame, decode, encode
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.protocols.libraries import Libraries, direction_of, made_of, values_in
from tests.protocols.peer import Values
from tests.protocols.specs import FILES, messages_of, model_of, values_of
from tests.protocols.streams import LARGE, all_ways, lines
from tests.rows import each_protocol

# No checksum ends their frames.
UNPROVEN = {"everything", "gauges", "sbus", "visca"}
WAYS = [pytest.param(name, way, id=f"{name}-{way.sender}") for name, way in all_ways()]


@pytest.mark.parametrize("name", FILES)
@in_turn("message", messages_of)
def test_a_published_frame_is_read_and_written_again(
    libraries: Libraries, name: str, message: str
) -> None:
    made, layout = libraries[name], messages_of(name)[message]
    for example in layout.message.examples:
        decoded = decode(model_of(name), layout.direction, example.hex)
        assert (decoded.layout, decoded.values) == (layout, example.values)
        # Reserved bytes are kept: receivers leave in them what they like.
        assert encode(layout, decoded.values, like=example.hex) == example.hex
        read = made.decode(example.hex, direction_of(made, layout.direction))
        assert (type(read).__name__, values_in(layout, read)) == (message, example.values)
        assert read.encode() == example.hex
        names = {each: getattr(made, each) for each in made.__all__}
        # Equal are those of the same frame, and reserved bytes are whatever the sender put there.
        made_again = eval(repr(read), names)  # noqa: S307 - it is our own
        assert made_again.to_dict() == read.to_dict()


@pytest.mark.parametrize("name", FILES)
@in_turn("message", messages_of)
def test_a_published_frame_is_found_on_a_line(
    libraries: Libraries, name: str, message: str
) -> None:
    made, layout = libraries[name], messages_of(name)[message]
    for example in layout.message.examples:
        decoder = made.StreamDecoder(direction_of(made, layout.direction))
        found = [*decoder.feed(example.hex), *decoder.feed(example.hex), *decoder.flush()]
        assert [event.encode() for event in found] == [example.hex] * 2
        if name not in UNPROVEN:
            spoilt = example.hex[:-1] + bytes([example.hex[-1] ^ 0x10])
            found = [*decoder.feed(spoilt), *decoder.flush()]
            assert all(isinstance(event, made.Noise) for event in found)


@pytest.mark.parametrize(("name", "way"), each_protocol(WAYS))
@few_each
@given(data=st.data())
def test_bytes_are_refused_for_the_same_reason(
    libraries: Libraries, name: str, way: Direction, data: st.DataObject
) -> None:
    made, line = libraries[name], data.draw(lines(name, way))
    expected = _judged(name, way, line)
    if isinstance(expected, tuple):
        with pytest.raises(made.DecodeError) as raised:
            made.decode(line, direction_of(made, way))
        assert (raised.value.reason.value, raised.value.offset) == expected
    else:
        read = made.decode(line, direction_of(made, way))
        assert values_in(messages_of(name)[type(read).__name__], read) == expected


def _judged(name: str, way: Direction, line: bytes) -> Values | tuple[str, int]:
    """Return the values in a frame; for other bytes, the reason and the offset."""
    try:
        return decode(model_of(name), way, line).values
    except NotAFrame as refused:
        return refused.reason, refused.offset


@in_turn("convert", lambda: [bytes, bytearray, memoryview])
def test_a_list_of_bytes_may_be_given_as_bytes(
    libraries: Libraries, convert: Callable[[bytes], Any]
) -> None:
    # Of any size, behind a field that says it, and always as many.
    for name, message in (("dynamixel1", "Write"), ("modbus", "Coils"), ("ubx", "CfgMsg")):
        made, layout = libraries[name], messages_of(name)[message]
        for example in layout.message.examples:
            lists = {key: each for key, each in example.values.items() if isinstance(each, list)}
            given = {key: convert(bytes(each)) for key, each in lists.items()}
            assert made_of(made, layout, {**example.values, **given}).encode() == example.hex


@pytest.mark.parametrize("name", each_protocol(FILES))
def test_the_examples_of_a_library_are_true(libraries: Libraries, name: str) -> None:
    messages = import_module(f"{libraries[name].__name__}.messages")
    found = doctest.testmod(messages)
    assert found.failed == 0
    assert found.attempted >= len(messages_of(name))


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
