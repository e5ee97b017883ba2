"""Tables of every protocol hold the events of its decoder, vectorised or not."""

from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any

import pytest
from framegen.language.values import Direction
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES, model_of
from tests.protocols.streams import frames, lines, sent
from tests.rows import some
from tests.unit.runtime.tables.hostile import hostile_lines, sealing
from tests.unit.runtime.tables.rows import places_of_reference, rows_in_tables, rows_of_decoder
from tests.unit.runtime.tables.shown import is_shown

# Which protocols are searched at many places at once, by the sender, `any` for all of them; and
# why the others are not. What is searched in order is right as well, and slower.
NO_HEADER = "nothing constant begins a frame"
NO_ID = "no frame says which message it is"
NO_LENGTH = "no frame says how long it is"
SEVERAL = "frames differ in their parts"
UNSENT = "the checksum covers what is not sent"
END = "a constant ends each frame"
VECTORISED: dict[tuple[str, str], str | None] = {
    ("crsf", "controller"): None,
    ("crsf", "receiver"): None,
    ("crsf", "any"): None,
    ("dynamixel1", "controller"): None,
    ("dynamixel1", "actuator"): NO_ID,
    ("dynamixel1", "any"): SEVERAL,
    ("ibus", "changer"): NO_HEADER,
    ("ibus", "radio"): NO_HEADER,
    ("ibus", "any"): NO_HEADER,
    ("mavlink1", "ground"): UNSENT,
    ("mavlink1", "vehicle"): UNSENT,
    ("mavlink1", "any"): UNSENT,
    ("mhz19", "host"): NO_LENGTH,
    ("mhz19", "sensor"): NO_LENGTH,
    ("mhz19", "any"): SEVERAL,
    ("modbus", "client"): NO_HEADER,
    ("modbus", "device"): NO_HEADER,
    ("modbus", "any"): NO_HEADER,
    ("msp", "host"): None,
    ("msp", "controller"): SEVERAL,
    ("msp", "any"): SEVERAL,
    ("roboclaw", "host"): NO_LENGTH,
    ("roboclaw", "controller"): NO_HEADER,
    ("roboclaw", "any"): SEVERAL,
    ("sbus", "receiver"): NO_ID,
    ("sbus", "any"): NO_ID,
    ("tfmini", "sensor"): NO_ID,
    ("tfmini", "any"): NO_ID,
    ("ubx", "host"): None,
    ("ubx", "receiver"): None,
    ("ubx", "any"): None,
    ("visca", "controller"): SEVERAL,
    ("visca", "camera"): END,
    ("visca", "any"): SEVERAL,
    ("lxservo", "host"): None,
    ("lxservo", "servo"): None,
    ("lxservo", "any"): None,
    ("everything", "asker"): UNSENT,
    ("everything", "teller"): None,
    ("everything", "any"): SEVERAL,
    ("gauges", "panel"): NO_LENGTH,
    ("gauges", "gauge"): NO_ID,
    ("gauges", "any"): SEVERAL,
}


def ways_of(name: str) -> list[Direction | None]:
    """Return the directions of a protocol in which something is sent, and None for all of them."""
    return [*(way for way in model_of(name).directions if sent(name, way)), None]


def sender(way: Direction | None) -> str:
    """Return who sends, as the table above has it."""
    return "any" if way is None else way.sender


CASES = some(
    [
        pytest.param(name, way, id=f"{name}-{sender(way)}")
        for name in FILES
        for way in ways_of(name)
    ],
    is_shown,
)
each_way = pytest.mark.parametrize(("name", "way"), CASES)


@cache
def lines_of(name: str, made: ModuleType) -> st.SearchStrategy[bytes]:
    """Return a strategy for lines on which every end of a protocol sends."""
    ways = [way for way in ways_of(name) if way is not None]
    plain = st.one_of([lines(name, way) for way in ways])
    every = st.one_of([frames(name, way) for way in ways])
    return st.lists(plain | hostile_lines(made, every, most=5), max_size=3).map(b"".join)


def filler(name: str) -> bytes:
    """Return what no frame begins with, and enough of it to decide all that is in front of it."""
    model = model_of(name)
    byte = next(byte for byte in range(256) if byte not in model.first_bytes)
    return bytes([byte]) * (2 * model.largest(model.directions) + 1)


def is_vectorised(made: ModuleType, direction: Any) -> bool:
    """Tell whether a library searches at many places at once."""
    layout: Any = import_module("framewire.recording.layout")
    searchable: Any = import_module("framewire.tables.search.searchable")
    library: Any = import_module(f"{made.__name__}._library")
    return bool(searchable.is_searchable(layout.layouts_of(library.CODEC).on(direction)))


@pytest.mark.parametrize("name", some(FILES, is_shown))
def test_what_is_vectorised_stays_so(libraries: Libraries, name: str) -> None:
    made = libraries[name]
    found = {
        (name, sender(way)): is_vectorised(made, None if way is None else direction_of(made, way))
        for way in ways_of(name)
    }
    assert found == {key: why is None for key, why in VECTORISED.items() if key[0] == name}


@each_way
@few_each
@given(data=st.data())
def test_tables_hold_what_the_decoder_and_the_reference_find(
    libraries: Libraries, name: str, way: Direction | None, data: st.DataObject
) -> None:
    made, model = libraries[name], model_of(name)
    line = data.draw(lines_of(name, made))
    block = data.draw(st.sampled_from([1, 7, 64, 600, None]))
    # Kilobytes in stretches of a few bytes show nothing that a short line does not.
    if VECTORISED[name, sender(way)] is None and (block is None or block > 7):
        line += data.draw(st.sampled_from([b"", filler(name)]))
    direction = None if way is None else direction_of(made, way)
    found = rows_in_tables(made, line, direction, block=block)
    assert found == rows_of_decoder(made, line, direction)
    reference = ReferenceDecoder(model, model.directions if way is None else [way])
    assert [row.place for row in found] == places_of_reference(reference.decode(line))


def test_an_unknown_frame_that_ends_otherwise_is_one_row(libraries: Libraries) -> None:
    made = libraries["everything"]
    # Its length fits, and nothing proves more: the byte 0A at its end is missing.
    frame = bytes.fromhex("C0 DE 07 2C 01 07 02 00 09 02 AA BB 00 00 00")
    (row,) = rows_in_tables(made, frame, made.Direction.ASKER_TO_TELLER)
    assert (row.table, row.size) == ("unknown", len(frame))
    assert (row.fields["station"], row.fields["class"], row.fields["kind"]) == (300, 9, 2)
    assert row.fields["parameters"] == b"\xaa\xbb"


def test_a_checksum_is_not_taken_for_a_number_that_is_absent(libraries: Libraries) -> None:
    made = libraries["everything"]
    # Its last byte, AB, would be too high for the number that may stand there.
    line = made.Tail(first=1).encode() + filler("everything")
    first, *_ = rows_in_tables(made, line, made.Direction.TELLER_TO_ASKER)
    assert (first.table, first.offset) == ("Tail", 0)


def test_a_character_that_is_none_and_an_address_that_is_none_are_refused(
    libraries: Libraries,
) -> None:
    made = libraries["everything"]
    frame = bytearray(made.Texts(name="a", note="b").encode())
    frame[5] = 0x80
    line = sealing(made)(bytes(frame)) + filler("everything")
    first, *_ = rows_in_tables(made, line, made.Direction.TELLER_TO_ASKER)
    assert (first.table, first.offset, first.reason) == ("noise", 0, "out of range")
    servo = libraries["lxservo"]
    frame = bytearray(servo.MoveRead(servo_id=1).encode())
    frame[2] = 0xFF
    line = sealing(servo)(bytes(frame)) + filler("lxservo")
    first, *_ = rows_in_tables(servo, line, servo.Direction.HOST_TO_SERVO)
    assert (first.table, first.offset, first.reason) == ("noise", 0, "out of range")
