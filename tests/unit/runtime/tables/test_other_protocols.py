"""Tables of every protocol hold the events of its decoder: vectorised or not, in CSV as well."""

import struct
from functools import cache
from importlib import import_module
from itertools import zip_longest
from types import ModuleType
from typing import Any

import pyarrow as pa
import pytest
from framegen.language.values import Direction
from framegen.model.checksums import CHECKSUMS
from framewire.recording.layout import layouts_of
from framewire.tables.search.searchable import is_searchable
from framewire.tables.stats.statistics import statistics
from hypothesis import example, given
from hypothesis import strategies as st

from tests.factories import compiled_of, data_in, library, library_files
from tests.few_each import few_each
from tests.handed import handed_by
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES, model_of
from tests.protocols.streams import frames, lines, sent
from tests.rows import some
from tests.unit.runtime.tables.conftest import is_shown
from tests.unit.runtime.tables.hostile import hostile_lines
from tests.unit.runtime.tables.rows import Row, rows_in_tables, rows_of_decoder

# Which protocols are searched at many places at once, by the sender, `any` for all of them; and
# why the others are not. What is searched in order is right as well, and slower.
NO_HEADER = "nothing constant begins a frame"
NO_ID = "no frame says which message it is"
NO_LENGTH = "no frame says how long it is"
SEVERAL = "frames differ in their parts"
UNSENT = "the checksum covers what is not sent"
END = "a constant ends each frame"
VECTORISED: dict[str, dict[str, str | None]] = {
    "crsf": {"controller": None, "receiver": None, "any": None},
    "dynamixel1": {"controller": None, "actuator": NO_ID, "any": SEVERAL},
    "ibus": {"changer": NO_HEADER, "radio": NO_HEADER, "any": NO_HEADER},
    "mavlink1": {"ground": UNSENT, "vehicle": UNSENT, "any": UNSENT},
    "mhz19": {"host": NO_LENGTH, "sensor": NO_LENGTH, "any": SEVERAL},
    "modbus": {"client": NO_HEADER, "device": NO_HEADER, "any": NO_HEADER},
    "msp": {"host": None, "controller": SEVERAL, "any": SEVERAL},
    "roboclaw": {"host": NO_LENGTH, "controller": NO_HEADER, "any": SEVERAL},
    "sbus": {"receiver": NO_ID, "any": NO_ID},
    "tfmini": {"sensor": NO_ID, "any": NO_ID},
    "ubx": {"host": None, "receiver": None, "any": None},
    "visca": {"controller": SEVERAL, "camera": END, "any": SEVERAL},
    "lxservo": {"host": None, "servo": None, "any": None},
    "everything": {"asker": UNSENT, "teller": None, "any": SEVERAL},
    "gauges": {"panel": NO_LENGTH, "gauge": NO_ID, "any": SEVERAL},
}


def ways_of(name: str) -> list[Direction | None]:
    """Return the directions of a protocol in which something is sent, and None for all of them."""
    return [*(way for way in model_of(name).directions if sent(name, way)), None]


def sender(way: Direction | None) -> str:
    """Return who sends, as the table above has it."""
    return "any" if way is None else way.sender


CASES = [
    pytest.param(name, way, id=f"{name}-{sender(way)}") for name in FILES for way in ways_of(name)
]
each_way = pytest.mark.parametrize(("name", "way"), some(CASES, is_shown))


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


@pytest.mark.parametrize("name", some(FILES, is_shown))
def test_what_is_vectorised_stays_so(libraries: Libraries, name: str) -> None:
    made = libraries[name]
    layouts = layouts_of(handed_by(made.__name__).codec)
    for way in ways_of(name):
        direction = None if way is None else direction_of(made, way)
        found = is_searchable(layouts.on(direction))
        assert bool(found) == (VECTORISED[name][sender(way)] is None), sender(way)


@each_way
def test_tables_hold_every_example(libraries: Libraries, name: str, way: Direction | None) -> None:
    made, messages = libraries[name], model_of(name).messages.values()
    sent = [each.message for each in messages if way in (None, each.direction)]
    line = b"".join(example.hex for message in sent for example in message.examples)
    direction = None if way is None else direction_of(made, way)
    for behind in (b"", filler(name)):
        expected = rows_of_decoder(made, line + behind, direction)
        assert rows_in_tables(made, line + behind, direction) == expected


@each_way
@few_each
@given(data=st.data())
def test_tables_hold_what_the_decoder_finds(
    libraries: Libraries, name: str, way: Direction | None, data: st.DataObject
) -> None:
    made = libraries[name]
    line = data.draw(lines_of(name, made))
    block = data.draw(st.sampled_from([1, 7, 64, 600, None]))
    # Kilobytes in stretches of a few bytes show nothing that a short line does not.
    if VECTORISED[name][sender(way)] is None and (block is None or block > 7):
        line += data.draw(st.sampled_from([b"", filler(name)]))
    direction = None if way is None else direction_of(made, way)
    expected = rows_of_decoder(made, line, direction)
    assert rows_in_tables(made, line, direction, block=block) == expected


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


# --- CSV -----------------------------------------------------------------------------------------
def expected(row: Row) -> list[tuple[str, dict[str, str]]]:
    """Return the rows of one event, from the fields that the decoder names."""
    begin = {"offset": str(row.offset), "size": str(row.size), "direction": row.direction or ""}
    fields = dict(row.fields or {})
    if row.table in ("noise", "unknown"):
        begin |= {"reason": str(row.reason), "unknown": str(row.table == "unknown").lower()}
        parameters = fields.pop("parameters", b"").hex(" ").upper()
        numbers = {name: text(value) for name, value in fields.items()}
        return [("noise", {**begin, **numbers, "parameters": parameters})]
    lists = {name: value for name, value in fields.items() if isinstance(value, list)}
    begin |= {name: text(fields[name]) for name in fields if name not in lists}
    if not lists:
        return [(row.table, begin)]
    flat = [flattened(name, value) for name, value in lists.items()]
    made = []
    for index, elements in enumerate(zip_longest(*flat, fillvalue={})):
        one = {name: value for each in elements for name, value in each.items()}
        made.append((row.table, {**begin, "index": str(index), **one}))
    return made or [(row.table, {**begin, "index": ""})]


def flattened(name: str, values: list[Any]) -> list[dict[str, str]]:
    return [
        {f"{name}.{each}": text(value) for each, value in element.items()}
        if isinstance(element, dict)
        else {name: text(element)}
        for element in values
    ]


def text(value: Any) -> str:
    if isinstance(value, bytes):  # a float, as its bits
        return str(struct.unpack(">d", value)[0])
    return "" if value is None else str(value)


# --- Any width -----------------------------------------------------------------------------------
WIDE = """
framegen: 2
protocol: {{name: wide, title: Wide, version: 1.0.0, authority: nobody, summary: Wide numbers.}}
sources: {{nobody: {{title: Made up, kind: document}}}}
endpoints: {{host: A host., device: A device.}}
link: {{baud: 9600}}
byte_order: big
frame:
  header: {{is: constant, bytes: A5 5A, about: The start.}}
  station: {{is: address, range: 0..{most}, type: u{bits}, about: A number.}}
  length: {{is: length, type: u8, counts: [parameters], about: How long.}}
  command: {{is: id, type: u{bits}, about: A number.}}
  parameters: {{is: body, about: The fields.}}
  check: {{is: checksum, type: u8, method: sum, covers: {covers}, about: A check.}}
messages: {{Low: {low}, High: {high}}}
"""
MESSAGE = """{{
  direction: host -> device, summary: A message., cite: nobody, id: {number}, length: 1,
  fields: {{level: {{type: u8, about: A level.}}}},
  examples: [{{title: One, hex: {frame}, values: {{station: 1, level: 7}}, cite: nobody}}],
}}"""


def wide_frame(bits: int, station: int, command: int, parameters: bytes) -> bytes:
    size = bits // 8
    covered = station.to_bytes(size, "big") + bytes([len(parameters)])
    covered += command.to_bytes(size, "big") + parameters
    return b"\xa5\x5a" + covered + bytes([CHECKSUMS["sum"].of(covered, 8)])


@cache
def wide_library(bits: int) -> dict[str, str]:
    """Return a library whose devices and messages have numbers of so many bits."""
    highest = (1 << bits) - 1
    low, high = (
        MESSAGE.format(number=number, frame=wide_frame(bits, 1, number, b"\x07").hex(" ").upper())
        for number in (1, highest)
    )
    covers = "[station, length, command, parameters]"
    text = WIDE.format(bits=bits, most=highest - 1, covers=covers, low=low, high=high)
    return library_files(compiled_of(data_in(text)))


@pytest.mark.parametrize("bits", [8, 16, 24, 32, 64])
def test_ids_and_addresses_of_any_width_are_in_the_tables_and_statistics(bits: int) -> None:
    highest = (1 << bits) - 1
    numbers = st.integers(0, highest) | st.sampled_from([0, 1, highest // 2, highest // 2 + 1])
    messages = st.tuples(numbers, numbers | st.sampled_from([1, highest]), st.binary(max_size=3))
    with library(wide_library(bits)) as made:

        @few_each
        @given(given=st.lists(messages, max_size=5))
        @example(given=[(highest - 1, highest - 1, b"\x07"), (highest - 1, highest, b"\x07")])
        def check(given: list[tuple[int, int, bytes]]) -> None:
            line = b"".join(wide_frame(bits, *each) for each in given)
            rows = rows_in_tables(made, line)
            assert rows == rows_of_decoder(made, line)
            found = statistics(handed_by(made.__name__).codec, line, form="raw")
            unknown = [row for row in rows if row.table == "unknown"]
            assert sum(each.count for each in found.unknown) == len(unknown)
            stations = {row.fields["station"] for row in rows if row.table in ("Low", "High")}
            assert {each.key for each in found.ranges} == stations

        check()
        noise = import_module(f"{made.__name__}.tables").schemas()["noise"]
        kind = pa.uint64() if bits == 64 else pa.int64()
        assert noise.field("station").type == noise.field("command").type == kind
