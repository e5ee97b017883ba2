"""Frames of every kind explained: by the reference and by the libraries alike, byte by byte."""

import json
from collections.abc import Iterator

import pytest
from framegen.explain import explain
from framegen.model.checksums import CHECK_DATA, CHECKSUMS
from framegen.model.codec import decode
from framegen.model.protocol import method_terms
from framewire.explain.checksum import checksum
from framewire.explain.explanation import Row
from framewire.explain.text import as_json, as_text

from tests.factories import compiled_of, data_in, library, library_files
from tests.handed import explanations_of
from tests.in_turn import in_turn
from tests.protocols.libraries import Libraries
from tests.protocols.specs import FILES, messages_of, model_of
from tests.rows import each_protocol
from tests.unit.site.peers import noisy_lines

METHODS = [(name, width) for name, method in CHECKSUMS.items() for width in method.widths]
EXAMPLES = [
    pytest.param(name, message, example.hex, id=f"{name} {message}: {example.title}")
    for name in FILES
    for message, layout in messages_of(name).items()
    for example in layout.message.examples
]


@in_turn("name, width", lambda: METHODS)
def test_a_checksum_is_worked_out_from_the_terms_of_its_method(name: str, width: int) -> None:
    assert checksum(method_terms(name), width, CHECK_DATA) == CHECKSUMS[name].checks[width]
    data = bytes(range(3, 250, 7))
    assert checksum(method_terms(name), width, data) == CHECKSUMS[name].of(data, width)


@in_turn("name, message, data", lambda: EXAMPLES)
def test_each_byte_and_value_of_an_example_is_explained(
    name: str, message: str, data: bytes
) -> None:
    model = model_of(name)
    found = explain(model, data, [model.messages[message].direction])
    (reading,) = found.readings
    assert (reading.message, found.hints) == (message, ())
    assert b"".join(row.data for row in reading.rows) == data
    values = {row.path: row.value for row in reading.rows}
    layout = model.messages[message]
    given = decode(model, layout.direction, data).values
    for slot in layout.arguments:
        # Absent values have no bytes.
        for path, value in flat(slot.name, given[slot.name], whole=slot.role == "packed"):
            assert values.get(path) == value, path


def flat(path: str, value: object, *, whole: bool) -> Iterator[tuple[str, object]]:
    """Yield the values in a value by path; packed numbers are one value of a frame."""
    if whole or not isinstance(value, list):
        yield path, value
        return
    for index, each in enumerate(value):
        if isinstance(each, dict):
            yield from ((f"{path}[{index}].{key}", number) for key, number in each.items())
        else:
            yield f"{path}[{index}]", each


def damaged(name: str) -> list[bytes]:
    """Return frames with damages, and noise."""
    found = [b"\0"]
    for layout in messages_of(name).values():
        for example in layout.message.examples[:1]:
            frame = example.hex
            middle = len(frame) // 2
            found += [
                frame[:-1],
                frame + b"\0",
                frame[:-1] + bytes([frame[-1] ^ 1]),
                frame[:middle] + bytes([frame[middle] ^ 0x55]) + frame[middle + 1 :],
                b"\x01" + frame,
            ]
    return found[:60] + noisy_lines(model_of(name), 6, 40)


@pytest.mark.parametrize("name", each_protocol(FILES))
def test_what_is_no_frame_is_explained_up_to_where_it_stops_being_one(name: str) -> None:
    model = model_of(name)
    for data in damaged(name):
        found = explain(model, data, model.directions)
        for refusal in found.refusals:
            assert rows_begin(refusal.rows, data[: refusal.offset]), (data.hex(" "), refusal)
            assert refusal.expected
        assert as_text(found)
        json.dumps(as_json(found))


def rows_begin(rows: tuple[Row, ...], data: bytes) -> bool:
    """Tell whether the rows, in order, are the first bytes of `data`, none left out."""
    return data.startswith(b"".join(row.data for row in rows))


@pytest.mark.parametrize("name", each_protocol(FILES))
def test_a_library_explains_as_the_reference_does(libraries: Libraries, name: str) -> None:
    made, model = libraries[name], model_of(name)
    explained = explanations_of(made.__name__)
    examples = (each.message.examples for each in messages_of(name).values())
    for data in [*(example.hex for each in examples for example in each), *damaged(name)]:
        here, there = explain(model, data, model.directions), explained(data)
        assert repr(there) == repr(here), data.hex(" ")


# What is said of bytes, by protocol: reason, what was due, and the hints.
MOVE, HEARTBEAT = "Move (host -> servo)", "Heartbeat (vehicle -> ground)"
SUM = "checksum is 17; the inverted sum of servo_id, length, command and parameters is 16"
CRC = "the crc-16/mcrf4xx of length, sequence, sender, message, payload and extra"
CENTRES = "E0 03 1F F8 C0 07 3E F0 81 0F 7C"
NAME = "C8 43 31 5F 4D 49 4E 00 00 00 00 00 00 00 00 00"
REFUSALS = [
    (
        *("lxservo", "55 55 01 07 01 F4 01 E8 03 17", "bad checksum", SUM),
        [f"with the right checksum they would be {MOVE}"],
    ),
    (
        *("lxservo", "55 55 01 08 01 F4 01 E8 03 17", "length mismatch"),
        "Move has a length of 7, not 8",
        [f"10 bytes have a length of 7; with that and the right checksum they would be {MOVE}"],
    ),
    (
        *("lxservo", "55 55 01 07 77 F4 01 E8 03 A0", "unknown command"),
        "no message host -> servo has the command 119",
        ["the checksum is right: a frame that this spec does not have"],
    ),
    (
        *("lxservo", "55 55 FF 07 01 F4 01 E8 03 16", "out of range"),
        *("servo_id is 255, outside 0..254", []),
    ),
    (
        *("modbus", "FF 01 05 CD 6B B2 0E 1B 45 E6", "bad header"),
        *("a frame begins with its unit, 0..247", []),
    ),
    (
        *("modbus", "11 03 06 AE 41 56 52 43 40 49 AC", "bad checksum"),
        "crc is 49 AC; the crc-16/modbus of unit, function and data is 49 AD",
        ["with the right crc they would be Holding (device -> client)"],
    ),
    (
        *("modbus", "11 03 05 AE 41", "count mismatch"),
        *("no Holding has a size of 5, of 1..125 elements", []),
    ),
    (
        *("ubx", "B5 62 06 77 06 00 E8 03 01 00 01 00 70 20", "unknown command"),
        "no message host -> receiver has the class 6 and message 119",
        ["the checksum is right: a frame that this spec does not have"],
    ),
    ("msp", "24 4D 00", "bad header", "a frame begins 24 4D 3C", []),
    ("sbus", f"0F {CENTRES} {CENTRES} 00 01", "bad trailer", "end is always 00", []),
    (
        *("mavlink1", f"FE 14 07 FF BE 14 FF FF 01 01 {NAME} 58 DF", "out of range"),
        *("name has the byte C8, which is not ASCII", []),
    ),
    (
        *("mavlink1", "FE 09 00 01 01 00 00 00 00 00 02 03 00 04 03 D0 15", "bad checksum"),
        f"checksum is D0 15; {CRC} is D0 14",
        [f"with the right checksum they would be {HEARTBEAT}"],
    ),
]


@in_turn("name, data, reason, due, hints", lambda: REFUSALS)
def test_a_refusal_says_what_was_due_and_what_the_bytes_would_be(
    name: str, data: str, reason: str, due: str, hints: list[str]
) -> None:
    model = model_of(name)
    found = explain(model, bytes.fromhex(data), model.directions)
    assert (reason, due) in [(each.reason, each.expected) for each in found.refusals]
    assert [hint.text for hint in found.hints] == hints


# Kinds of frames, and messages of the same ids, that only what follows tells apart.
LIKE_EACH_OTHER = """
framegen: 2
protocol: {name: lamps, title: Lamps, version: 1.0.0, authority: m, summary: Two lamps.}
sources: {m: {title: Manual, kind: document}}
endpoints: {host: Asks., lamp: Answers.}
link: {baud: 9600}
byte_order: big
frames:
  numbered:
    start: {is: constant, bytes: 7E}
    size: {is: length, type: u8, counts: [kind, number, body]}
    kind: {is: id, type: u8}
    number: {is: counter, type: u8}
    body: {is: body}
    check: {is: checksum, type: u8, method: xor, covers: [kind, body]}
  plain:
    start: {is: constant, bytes: 7E}
    size: {is: length, type: u8, counts: [kind, body]}
    kind: {is: id, type: u8}
    body: {is: body}
    check: {is: checksum, type: u8, method: xor, covers: [kind, body]}
messages:
  Wake: {frame: plain, id: 1, direction: host -> lamp, summary: Wake up., cite: m, length: 3,
    fields: {state: {type: u16, always: 1, about: Awake.}},
    examples: [{title: Wake, hex: 7E 03 01 00 01 00, values: {}, cite: m}]}
  Sleep: {frame: plain, id: 1, direction: host -> lamp, summary: Go to sleep., cite: m, length: 3,
    fields: {state: {type: u16, always: 0, about: Asleep.}},
    examples: [{title: Sleep, hex: 7E 03 01 00 00 01, values: {}, cite: m}]}
  Glow: {frame: numbered, id: 2, direction: host -> lamp, summary: Glow., cite: m, length: 3,
    fields: {level: {type: u8, about: How bright.}},
    examples: [{title: Glow, hex: 7E 03 02 00 02 00, values: {level: 2, number: 0}, cite: m}]}
"""


@in_turn(
    "data, reason, due",
    lambda: [
        (
            *("7E 03 01 01 02 02", "out of range"),
            "Wake: state is always 00 01; Sleep: state is always 00 00",
        ),
        ("7E 03 01 00 01 77", "bad checksum", "check is 77; the xor of kind and body is 00"),
        ("7E 03 02 00 02 01 00", "bad checksum", "check is 01; the xor of kind and body is 00"),
        ("7E 03 01 00", "too short", "a size of 3 makes 6 bytes"),
        ("7E 03 02 00 02 00 00", "trailing bytes", "a size of 3 makes 6 bytes"),
    ],
)
def test_what_nothing_tells_apart_is_explained_as_each(data: str, reason: str, due: str) -> None:
    compiled = compiled_of(data_in(LIKE_EACH_OTHER))
    assert compiled.findings == []
    frame = bytes.fromhex(data)
    here = explain(compiled.model, frame, compiled.model.directions)
    assert [(each.reason, each.expected) for each in here.refusals] == [(reason, due)]
    with library(library_files(compiled)) as made:
        assert repr(explanations_of(made.__name__)(frame)) == repr(here)
