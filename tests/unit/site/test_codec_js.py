"""The codec in the page, under node: compared with the reference, and with libraries.

tests/contract/conformance has what it encodes.
"""

import random
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from importlib import import_module
from itertools import accumulate
from typing import Any

import pytest
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode, values_of
from framegen.model.model import Model, derive
from framegen.model.stream import ReferenceDecoder
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data
from framewire.codec.hextext import HexError, read_hex

from tests.factories import BUSSERVO, compiled_file, data_of
from tests.hex_cases import HEX, NO_HEX, random_texts
from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.rows import each_protocol
from tests.unit.site.peers import Event, joined, noisy_lines
from tests.unit.site.reference import NODE, ROOT, reference
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

SERVO = reference("busservo").model
OTHERS = sorted({*(ROOT / "tests" / "specs").glob("*.yaml")} - {*FILES.values()})
SPECS = {"busservo": BUSSERVO, **{file.stem: file for file in OTHERS}, **FILES}

COVERED = ["command", "parameters"]
LENGTH_AND_BODY = {
    "length": {"is": "length", "type": "u8", "counts": ["length", *COVERED]},
    "command": {"is": "id", "type": "u8"},
    "parameters": {"is": "body"},
}
# Other envelopes of busservo than those of the specs, whether or not a spec can have them yet.
ENVELOPES: dict[str, dict[str, Any]] = {
    "a part behind the fields": {"end": {"is": "constant", "bytes": "0D 0A"}},
    "a header that overlaps itself": {"header": {"is": "constant", "bytes": "55 03 55"}},
    "a header in two parts": {
        "header": {"is": "constant", "bytes": "55"},
        "version": {"is": "constant", "bytes": "01"},
        **LENGTH_AND_BODY,
    },
    "a checksum that covers one behind it": {
        "header": {"is": "constant", "bytes": "55 55"},
        "sum": {"is": "checksum", "type": "u8", "method": "sum", "covers": ["command", "crc"]},
        **LENGTH_AND_BODY,
        "crc": {"is": "checksum", "type": "u16", "method": "crc-16/modbus", "covers": COVERED},
    },
    "an id of two bytes before a length of two": {
        "header": {"is": "constant", "bytes": "55 55"},
        "command": {"is": "id", "type": "u16"},
        "length": {"is": "length", "type": "u16", "counts": ["length", "parameters"]},
        "parameters": {"is": "body"},
    },
}


of_each = pytest.mark.parametrize("name", each_protocol([*SPECS, *ENVELOPES]))

PROGRAM = """
const codec = makeCodec(asked.protocol);
const plain = ({ type, bytes, message, reason, fields, at, refusedAt }) => (
  [type, Array.from(bytes), message || reason, fields ?? null, at, refusedAt ?? null]);
function answer(ask, first, second, room) {
  if (ask === "hex") return Array.from(parseHex(first));
  if (ask === "encode") return Array.from(codec.encode(first, second));
  if (ask === "frame") {
    const { message, fields, reason, offset } = codec.decodeFrame(second, first);
    return message ? [message, fields] : [reason, offset];
  }
  const stream = codec.makeStream({ direction: first, maxFrame: room });
  return second.flatMap((part) => (part === null ? [...stream.flush().map(plain), null]
    : stream.feed(part).map(plain)));
}
const answers = asked.questions.map((question) => {
  try {
    return answer(...question);
  } catch (error) {
    if (error instanceof Unusable) return { refused: error.message };
    throw error;
  }
});
"""


def ask(model: Model, questions: list[tuple[Any, ...]]) -> Any:
    """Return the answers of the page's codec."""
    asked = {"protocol": protocol_data(model), "questions": questions}
    return run_script(codec_scripts(model), PROGRAM, asked)


@cache
def model_of(name: str) -> Model:
    """Return the model of one of SPECS, or of busservo in one of ENVELOPES."""
    if name in SPECS:
        return compiled_file(SPECS[name]).model
    data = data_of(BUSSERVO)
    parts = ENVELOPES[name]
    data["frame"] = parts if "parameters" in parts else {**data["frame"], **parts}
    return derive(Spec.model_validate(data))


@cache
def lines_of(name: str) -> list[bytes]:
    return noisy_lines(model_of(name), 12, 100 if name in FILES else 400)


def ways_of(model: Model) -> list[tuple[str | None, list[Direction]]]:
    """Return each direction, and all together, as the page and as the reference take them."""
    return [*((way.key, [way]) for way in model.directions), (None, model.directions)]


@of_each
def test_streams_are_decoded_as_the_reference_decodes_them(name: str) -> None:
    model, chance = model_of(name), random.Random(name)  # noqa: S311 - the same in every run
    questions: list[tuple[Any, ...]] = []
    expected: list[list[Event]] = []
    least = min(frame.least for frame in model.envelopes.values())
    for line in lines_of(name):
        for key, ways in ways_of(model):
            largest = model.largest(ways)
            room = max(least, chance.choice([largest, largest, 64, 20, 8, least]))
            parts = [*_cut(chance, line)]
            questions.append(("stream", key, parts, room))
            expected.append(joined(_events(model, ways, room, parts)))
    for question, found, right in zip(questions, ask(model, questions), expected, strict=True):
        events = [each for each in found if each]
        ends = [at + len(data) for _, data, _, _, at, _ in events]
        assert [at for *_, at, _ in events] == [0, *ends][: len(events)], question
        assert joined(map(_said, found)) == right, question


def _said(event: list[Any] | None) -> Event:
    if event is None:
        return ["quiet", "", None]
    kind, data, what, values, _, _ = event
    return [kind, bytes(data).hex(), (what, values)]


def _cut(chance: random.Random, line: bytes) -> Iterator[bytes | None]:
    step = chance.choice([1, 2, 5, 64, 1000])
    for at in range(0, len(line), step):
        yield line[at : at + step]
        if chance.random() < 0.1:
            yield None
    if chance.random() < 0.7:
        yield None


def _events(
    model: Model, ways: list[Direction], room: int, parts: list[bytes | None]
) -> Iterator[Event]:
    for event in ReferenceDecoder(model, ways, room).follow(parts):
        if event is None:
            yield ["quiet", "", None]
        elif event.message is None:
            yield [event.kind, event.data.hex(), (event.reason, None)]
        else:
            values = values_of(event.message, event.data)
            yield [event.kind, event.data.hex(), (event.message.name, values)]


@of_each
def test_single_frames_are_judged_as_the_reference_judges_them(name: str) -> None:
    model = model_of(name)
    asked = [
        (key, ways, line[:end])
        for line in lines_of(name)
        for key, ways in ways_of(model)
        for end in (len(line), len(line) // 2, 10)
    ]
    found = ask(model, [("frame", key, data) for key, _, data in asked])
    for (key, ways, data), said in zip(asked, found, strict=True):
        assert said == _verdict(model, None if key is None else ways[0], data), data.hex(" ")


def _verdict(model: Model, way: Direction | None, data: bytes) -> list[Any]:
    try:
        decoded = decode(model, way, data)
    except NotAFrame as error:
        return [error.reason, error.offset]
    return [decoded.layout.name, decoded.values]


# What a line says both ways: where each piece stands, its bytes, and the byte where it was refused.
PIECES = {
    "noise without a header": ("00 01 02", [(0, "000102", 0)]),
    "a header that ends too early": ("00 55 AA", [(0, "0055aa", 0)]),
    "a refused header begins one": ("55 55 01 00 55 55 00", [(0, "55550100", 2), (4, "555500", 6)]),
    "a count that is wrong": ("55 55 08 03 02 E8", [(0, "5555080302e8", 4)]),
    "what was cut short": ("55 55 08 03 01", [(0, "5555080301", 5)]),
    "a run of header bytes is one": ("55 55 55 55 55 01", [(0, "555555", 3), (3, "555501", 5)]),
    "a frame of unknown id": ("00 55 55 03 63 01", [(0, "00", 0), (1, "5555036301", 4)]),
}


@in_turn("title", lambda: PIECES)
def test_noise_is_reported_in_pieces_with_the_refused_byte(title: str) -> None:
    text, expected = PIECES[title]
    cuts = [[bytes.fromhex(text), None], [*map(bytes.fromhex, text.split()), None]]
    whole, cut = ask(SERVO, [("stream", None, parts, 257) for parts in cuts])
    found = [(at, bytes(data).hex(), refused) for _, data, _, _, at, refused in whole[:-1]]
    assert found == expected
    # A piece that is cut goes on, at its own place, and was refused where it was.
    assert bytewise(cut) == bytewise(whole)


def bytewise(events: list[Any]) -> list[tuple[int, int, int]]:
    """Return each byte of noise: its place on the line, its value, and the refused place."""
    pieces = [(at, enumerate(data), refused) for _, data, _, _, at, refused in events[:-1]]
    return [(at + index, byte, refused) for at, data, refused in pieces for index, byte in data]


# Values that no frame can carry, by protocol and message: what is changed, and the refusal.
UNUSABLE: dict[tuple[str, str], list[tuple[dict[str, Any], str]]] = {
    ("busservo", "ServoMove"): [
        ({"time_ms": 65536}, "time_ms: 65536 is outside 0..65535"),
        ({"time_ms": 1.5}, "time_ms: a whole number is due"),
        ({"targets": []}, "targets: 0 items is outside 1..83"),
        ({"targets": [{"servo_id": 1}]}, "targets[0].position: a whole number is due"),
        (
            {"targets": [{"servo_id": 1, "position": 70000}]},
            "targets[0].position: 70000 is outside 0..65535",
        ),
    ],
    ("lxservo", "Move"): [
        ({"servo_id": 255}, "servo_id: 255 is outside 0..254"),
        ({"servo_id": 1.5}, "servo_id: a whole number is due"),
    ],
    ("sbus", "Channels"): [
        ({"channels": [0] * 15}, "channels: 15 numbers, and it has 16"),
        ({"channels": [2048] * 16}, "channels[0]: 2048 is outside 0..2047"),
    ],
    ("mavlink1", "ParameterRead"): [
        ({"name": 17 * "a"}, "name: 17 characters, and it has room for 16"),
        ({"name": "é"}, "name: “é” is not ASCII"),
    ],
    ("mavlink1", "Parameter"): [({"value": 1e39}, "value: 1e+39 does not fit")],
    ("mavlink1", "SystemTime"): [
        ({"unix_us": 1 << 64}, f"unix_us: {1 << 64} is outside 0..{(1 << 64) - 1}")
    ],
    ("modbus", "Holding"): [({"registers": []}, "registers: 0 items is outside 1..125")],
}


@in_turn("name, message", lambda: UNUSABLE)
def test_values_that_no_frame_can_carry_are_refused(name: str, message: str) -> None:
    model, rows = model_of(name), UNUSABLE[name, message]
    values = model.messages[message].message.examples[0].values
    found = ask(model, [("encode", message, {**values, **wrong}) for wrong, _ in rows])
    assert found == [{"refused": refusal} for _, refusal in rows]


def test_hex_is_read_as_the_library_reads_it() -> None:
    texts = [text for text, _ in HEX] + NO_HEX + random_texts(1000)
    expected: list[Any] = [None] * len(texts)
    for at, text in enumerate(texts):
        with suppress(HexError):
            expected[at] = list(read_hex(text))
    replies = ask(SERVO, [("hex", text) for text in texts])
    assert [each if isinstance(each, list) else None for each in replies] == expected


# ---------------------------------------------------------------------------- long lines

# More than two of the blocks that the codec copies into, and of the windows that it looks at.
SIZE = 150_000
LONG = """
const codec = makeCodec(asked.protocol), line = Uint8Array.from(asked.line);
function decoded(cuts) {
  const stream = codec.makeStream({ direction: asked.direction }), events = [], held = [];
  let start = 0;
  for (const end of [...cuts, line.length]) {
    const chunk = line.slice(start, end);
    events.push(...stream.feed(chunk));
    // What was fed is the caller's, who may use it again.
    chunk.fill(0);
    held.push([stream.pending, stream.position]);
    start = end;
  }
  events.push(...stream.flush());
  held.push([stream.pending, stream.position]);
  return [events.map(({ type, at, size, bytes, message, reason }) => (
    [type, at, size, Buffer.from(bytes).toString("hex"), message || reason])), held];
}
const answers = asked.cuts.map(decoded);
"""


def cuts(chance: random.Random, most: int) -> list[int]:
    """Return where a line is cut, into chunks of up to so many bytes."""
    found = [0]
    while found[-1] < SIZE:
        found.append(found[-1] + chance.randint(1, most))
    return found[1:-1]


@in_turn("name", lambda: ["busservo", "lxservo"])
def test_a_long_line_is_decoded_as_by_the_library_however_it_is_cut(name: str) -> None:
    model = model_of(name)
    chance = random.Random(name)  # noqa: S311 - the same line in every run
    line = b""
    while len(line) < SIZE:
        line += b"".join(noisy_lines(model, len(line), 100))
        # Noise that is longer than a block has an event that is.
        line += bytes(chance.choice([0, 0, 70_000 if len(line) > SIZE // 2 else 0]))
    line = line[:SIZE]
    way = model.directions[0]
    library = import_module(name)
    decoder = library.StreamDecoder(library.Direction(way.key))
    expected = [*decoder.feed(line), *decoder.flush()]
    asked = {"protocol": protocol_data(model), "line": line, "direction": way.key}
    asked["cuts"] = [[], cuts(chance, 50), cuts(chance, 100_000)]
    for events, held in run_script(codec_scripts(model), LONG, asked):
        said = [[kind, hex_, what] for kind, _, _, hex_, what in events]
        assert joined(said) == joined(map(_as_the_page, expected))
        assert [(at, size) for _, at, size, _, _ in events] == _places(events)
        assert held[-1] == [0, SIZE]
        largest = model.largest([way])
        assert [pending for pending, _ in held if pending > largest] == []


def _places(events: list[Any]) -> list[tuple[int, int]]:
    """Return where events begin that follow each other, and how many bytes they have."""
    sizes = [len(event[3]) // 2 for event in events]
    return [*zip(accumulate([0, *sizes[:-1]]), sizes, strict=True)]


def _as_the_page(event: Any) -> Event:
    """Return an event of the library as the page gives it."""
    name = type(event).__name__
    if name == "Noise":
        return ["noise", event.data.hex(), event.reason.value]
    if name == "UnknownFrame":
        return ["unknown", event.data.hex(), "unknown command"]
    return ["message", event.encode().hex(), name]
