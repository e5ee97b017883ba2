"""The codec in the page, under node: compared with the reference."""

import random
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path
from typing import Any, TypeAlias

import pytest
from busservo._codec.hextext import HexError, read_hex
from framegen.compile import Compiled
from framegen.conformance.language import (
    Decode,
    Question,
    Stream,
    answer,
    joined,
)
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode, encode
from framegen.model.layout import MessageLayout
from framegen.model.model import Model, derive
from framegen.site.scripts.protocol_data import protocol_data

from tests.contract.conformance.answerers import page_command
from tests.factories import BUSSERVO, compiled_file, data_of
from tests.hex_cases import HEX, NO_HEX, random_texts
from tests.protocols.specs import FILES
from tests.unit.conformance.harness import run
from tests.unit.site import peers
from tests.unit.site.peers import noisy_lines, reference_events
from tests.unit.site.reference import NODE, ROOT, reference
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

# Those of other kinds of frames are in test_codec_of_protocols.
OTHERS = sorted({*(ROOT / "tests" / "specs").glob("*.yaml")} - {*FILES.values()})
SPECS = [ROOT / "spec" / "busservo.yaml", *OTHERS]


class Page:
    """The page of one protocol, and the answers of its codec."""

    def __init__(self, compiled: Compiled, folder: Path) -> None:
        self.compiled = compiled
        self.model = compiled.model
        self.command = page_command(compiled, folder)

    def answers(self, questions: list[Question]) -> list[list[str]]:
        replies = run(self.command, [question.line for question in questions])
        return [joined(lines) for lines in replies]


@pytest.fixture(params=SPECS, ids=lambda file: file.stem, scope="module")
def page(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Page:
    return Page(compiled_file(request.param), tmp_path_factory.mktemp("page"))


def test_lines_and_single_frames_are_decoded_as_the_reference_decodes_them(page: Page) -> None:
    questions = [*streams(page.model, 17, 600), *single_frames(page.model, 9, 300)]
    for question, reply in zip(questions, page.answers(questions), strict=True):
        assert reply == joined(answer(page.model, question)), question.line


def streams(model: Model, seed: int, number: int) -> Iterator[Question]:
    """Return noisy lines, cut anywhere, quiet anywhere, with room for frames of several sizes."""
    chance = random.Random(seed)  # noqa: S311 - the same lines in every run
    for line in noisy_lines(model, seed, number):
        for way in model.directions:
            largest = model.largest([way])
            room = chance.choice([largest, largest, 64, model.frame.least + 8, model.frame.least])
            yield Stream(way, max(room, model.frame.least), tuple(_parts(chance, line)))


def _parts(chance: random.Random, line: bytes) -> Iterator[bytes | None]:
    step = chance.choice([1, 2, 5, 64, 1000])
    for at in range(0, len(line), step):
        yield line[at : at + step]
        if chance.random() < 0.1:
            yield None
    if chance.random() < 0.7:
        yield None


def single_frames(model: Model, seed: int, number: int) -> Iterator[Question]:
    """Return the beginnings of noisy lines, each as one frame."""
    for line in noisy_lines(model, seed, number):
        for way in model.directions:
            for end in (len(line), len(line) // 2, 10):
                yield Decode(way, line[:end])


# What a line says, by the parts in which it comes.
LINES = {
    "a frame of unknown id is shown": (
        "555504630102 55550207 quiet",
        ["unknown 555504630102", "message ActionGroupStop 55550207", "quiet"],
    ),
    "it is shown once all of it came": ("5555046301 02", ["unknown 555504630102"]),
    "it waits for all of it": ("5555046301", []),
    "it ends when the line goes quiet": (
        "5555046301 quiet 02 quiet",
        ["noise unknown-command 5555046301", "quiet", "noise bad-header 02", "quiet"],
    ),
    "a message in it is worth more": (
        "5555 08630155 5502 07",
        ["noise unknown-command 5555086301", "message ActionGroupStop 55550207"],
    ),
    "and so is what may become one by its own bytes": (
        "55550463 5555 0207 quiet",
        ["noise unknown-command 55550463", "message ActionGroupStop 55550207", "quiet"],
    ),
    "whatever the bytes behind it say": (
        "55550463 5555 01 quiet",
        ["noise unknown-command 55550463", "noise length-mismatch 555501", "quiet"],
    ),
    "a refused length is no claim": (
        "55550163 quiet",
        ["noise length-mismatch 55550163", "quiet"],
    ),
    "a header that has begun waits": ("0055", ["noise bad-header 00"]),
    "a frame that is cut short is too short": (
        "55550803 quiet",
        ["noise too-short 55550803", "quiet"],
    ),
}


@pytest.mark.parametrize("title", LINES)
def test_a_line_is_decoded_into_these_events(found: dict[str, list[str]], title: str) -> None:
    assert found[title] == LINES[title][1]


@pytest.fixture(scope="module")
def found(busservo: Page) -> dict[str, list[str]]:
    """Return the events in each of LINES; one process decodes them all."""
    way = busservo.model.directions[0]
    questions: list[Question] = []
    for line, _ in LINES.values():
        parts = [None if part == "quiet" else bytes.fromhex(part) for part in line.split()]
        questions.append(Stream(way, 257, tuple(parts)))
    return dict(zip(LINES, busservo.answers(questions), strict=True))


@pytest.fixture(scope="module")
def busservo(tmp_path_factory: pytest.TempPathFactory) -> Page:
    return Page(reference("busservo").compiled, tmp_path_factory.mktemp("page"))


def test_a_recorded_line_is_decoded_as_the_reference_decodes_it(busservo: Page) -> None:
    line = (ROOT / "tests" / "captures" / "noisy_line.bin").read_bytes()
    model = busservo.model
    questions: list[Question] = [
        Stream(way, model.largest([way]), (line, None)) for way in model.directions
    ]
    assert busservo.answers(questions) == [
        joined(answer(model, question)) for question in questions
    ]


# ---------------------------------------------------------------------------- beyond the language

# Asks the scripts of the page, as they are published, the questions that no other codec gets.
HARNESS = """
function answer(codec, { ask, text, name, fields }) {
  try {
    if (ask === "hex") return Array.from(parseHex(text));
    if (ask === "encode") return Array.from(codec.encode(name, fields));
    if (ask === "frame") return codec.decodeFrame(parseHex(text), null);
    const stream = codec.makeStream();
    if (ask === "line") return stream.flush(parseHex(text));
    const cut = Array.from(parseHex(text)).flatMap((byte) => stream.feed([byte]));
    return [...cut, ...stream.flush()];
  } catch (error) {
    if (error instanceof Unusable) return { refused: error.message };
    throw error;
  }
}
const answers = asked.map(([protocol, questions]) => {
  const codec = makeCodec(protocol);
  return questions.map((question) => answer(codec, question));
});
"""


Asked: TypeAlias = "list[dict[str, Any]]"


def ask(model: Model, questions: Asked) -> list[Any]:
    """Return the answers of the page's scripts to each question about a protocol."""
    (answers,) = ask_about([(model, questions)])
    return answers


def ask_about(batches: Sequence[tuple[Model, Asked]]) -> list[list[Any]]:
    """Return the answers to questions about several protocols."""
    (codec,) = [
        text
        for _, text in reference("busservo").pages["decoder.html"].scripts
        if "function makeCodec" in text
    ]
    given = [(protocol_data(model), asked) for model, asked in batches]
    answers: list[list[Any]] = run_script([], HARNESS, given, codec)
    return answers


# Other envelopes than those of the specs, whether or not a spec can have them yet.
ENVELOPES: dict[str, dict[str, Any]] = {
    "as it is": {},
    "a part behind the fields": {"end": {"is": "constant", "bytes": "0D 0A"}},
    "a header that overlaps itself": {"header": {"is": "constant", "bytes": "55 03 55"}},
    "a header in two parts": {
        "header": {"is": "constant", "bytes": "55"},
        "version": {"is": "constant", "bytes": "01"},
        "length": {"is": "length", "type": "u8", "counts": ["length", "command", "parameters"]},
        "command": {"is": "id", "type": "u8"},
        "parameters": {"is": "body"},
    },
    "a checksum that covers one behind it": {
        "header": {"is": "constant", "bytes": "55 55"},
        "sum": {"is": "checksum", "type": "u8", "method": "sum", "covers": ["command", "crc"]},
        "length": {"is": "length", "type": "u8", "counts": ["length", "command", "parameters"]},
        "command": {"is": "id", "type": "u8"},
        "parameters": {"is": "body"},
        "crc": {
            "is": "checksum",
            "type": "u16",
            "method": "crc-16/modbus",
            "covers": ["command", "parameters"],
        },
    },
    "an id of two bytes before a length of two": {
        "header": {"is": "constant", "bytes": "55 55"},
        "command": {"is": "id", "type": "u16"},
        "length": {"is": "length", "type": "u16", "counts": ["length", "parameters"]},
        "parameters": {"is": "body"},
    },
}


@cache
def wrapped(title: str) -> Model:
    """Return the protocol in one of ENVELOPES."""
    data = data_of(BUSSERVO)
    parts = ENVELOPES[title]
    data["frame"] = parts if "parameters" in parts else {**data["frame"], **parts}
    return derive(Spec.model_validate(data))


def lines_in(model: Model) -> list[bytes]:
    return noisy_lines(model, 5, 400)


def examples_of(model: Model) -> list[tuple[MessageLayout, dict[str, Any]]]:
    return [
        (message, example.values)
        for message in model.messages.values()
        for example in message.message.examples
    ]


@pytest.fixture(scope="module")
def unwrapped() -> dict[str, tuple[list[Any], list[Any]]]:
    """Return what the page makes of lines and of examples in each of ENVELOPES."""
    models = [wrapped(title) for title in ENVELOPES]
    lines = [[{"ask": "line", "text": line.hex()} for line in lines_in(model)] for model in models]
    examples = [
        [{"ask": "encode", "name": each.name, "fields": values} for each, values in cases]
        for cases in map(examples_of, models)
    ]
    both = [read + written for read, written in zip(lines, examples, strict=True)]
    return {
        title: (answers[: len(read)], answers[len(read) :])
        for title, read, answers in zip(
            ENVELOPES, lines, ask_about([*zip(models, both, strict=True)]), strict=True
        )
    }


@pytest.mark.parametrize("title", ENVELOPES)
def test_any_envelope_is_decoded_as_the_reference_decodes_it_both_ways(
    unwrapped: dict[str, tuple[list[Any], list[Any]]], title: str
) -> None:
    model, (replies, _) = wrapped(title), unwrapped[title]
    for line, events in zip(lines_in(model), replies, strict=True):
        said = [
            [event["type"], bytes(event["bytes"]).hex(), event.get("message", event.get("reason"))]
            for event in events
        ]
        assert peers.joined(said) == reference_events(model, line, None), line.hex(" ")
        ends = [event["at"] + len(event["bytes"]) for event in events]
        assert [event["at"] for event in events] == [0, *ends][: len(events)], line.hex(" ")


@pytest.mark.parametrize("title", ENVELOPES)
def test_any_envelope_is_encoded_as_the_reference_encodes_it(
    unwrapped: dict[str, tuple[list[Any], list[Any]]], title: str
) -> None:
    cases, (_, replies) = examples_of(wrapped(title)), unwrapped[title]
    assert replies == [list(encode(each, values)) for each, values in cases]


# What a line says both ways: where each piece stands, its bytes, and the byte where it was refused.
PIECES = {
    "noise without a header": ("00 01 02", [(0, "000102", 0)]),
    "a header that ends too early": ("00 55 AA", [(0, "0055aa", 0)]),
    "each refused header begins a piece": (
        "55 55 01 00 55 55 00",
        [(0, "55550100", 2), (4, "555500", 6)],
    ),
    "a count that is wrong": ("55 55 08 03 02 E8", [(0, "5555080302e8", 4)]),
    "what was cut short": ("55 55 08 03 01", [(0, "5555080301", 5)]),
    "a run of header bytes is one": (
        "55 55 55 55 55 01",
        [(0, "555555", 3), (3, "555501", 5)],
    ),
    "a frame of unknown id": ("00 55 55 03 63 01", [(0, "00", 0), (1, "5555036301", 4)]),
}


@pytest.fixture(scope="module")
def reported() -> dict[str, tuple[Any, Any]]:
    """Return the pieces of each of PIECES, read as a whole, and byte by byte."""
    asked = [{"ask": how, "text": text} for text, _ in PIECES.values() for how in ("line", "bytes")]
    replies = ask(reference("busservo").model, asked)
    return dict(zip(PIECES, zip(replies[::2], replies[1::2], strict=True), strict=True))


@pytest.mark.parametrize("title", PIECES)
def test_noise_is_reported_in_pieces_with_the_refused_byte(
    reported: dict[str, tuple[Any, Any]], title: str
) -> None:
    whole, cut = reported[title]
    assert [
        (each["at"], bytes(each["bytes"]).hex(), each["refusedAt"]) for each in whole
    ] == PIECES[title][1]
    # A piece that is cut goes on, at its own place, and was refused where it was.
    assert bytewise(cut) == bytewise(whole)


def bytewise(events: list[dict[str, Any]]) -> list[tuple[int, int, int]]:
    """Return each byte of noise: its place on the line, its value, and the refused place."""
    return [
        (event["at"] + index, byte, event["refusedAt"])
        for event in events
        for index, byte in enumerate(event["bytes"])
    ]


@pytest.mark.parametrize("name", ["busservo", "greenhouse"])
def test_single_frames_of_either_way_are_judged_as_the_reference_judges_them(name: str) -> None:
    model = reference(name).model
    lines = [line[:end] for line in noisy_lines(model, 6, 300) for end in (len(line), 10)]
    replies = ask(model, [{"ask": "frame", "text": line.hex()} for line in lines])
    for line, found in zip(lines, replies, strict=True):
        said = found.get("message") or [found["reason"], found["offset"]]
        assert said == verdict(model, None, line), line.hex(" ")


def verdict(model: Model, way: Direction | None, data: bytes) -> Any:
    """Return the name of the message that `data` is, or why and where it is none."""
    try:
        return decode(model, way, data).layout.name
    except NotAFrame as error:
        return [error.reason, error.offset]


# Values of a ServoMove, and what is wrong with them.
UNUSABLE: list[tuple[dict[str, Any], str]] = [
    ({"time_ms": 65536, "targets": [{"servo_id": 1, "position": 2}]}, "time_ms: 65536 is out"),
    (
        {"time_ms": 1, "targets": [{"servo_id": 1, "position": 70000}]},
        "targets[0].position: 70000 is outside 0..65535",
    ),
    ({"time_ms": 1, "targets": []}, "targets: 0 items is outside 1..83"),
    ({"time_ms": 1.5, "targets": [{"servo_id": 1, "position": 2}]}, "time_ms: a whole number"),
    ({"time_ms": 1, "targets": [{"servo_id": 1}]}, "targets[0].position: a whole number"),
]


def test_values_that_no_frame_can_carry_are_refused() -> None:
    asked = [{"ask": "encode", "name": "ServoMove", "fields": fields} for fields, _ in UNUSABLE]
    replies = ask(reference("busservo").model, asked)
    for (fields, error), reply in zip(UNUSABLE, replies, strict=True):
        assert reply["refused"].startswith(error), fields


def test_hex_is_read_as_the_library_reads_it() -> None:
    texts = [text for text, _ in HEX] + NO_HEX + random_texts(1000)
    expected: list[Any] = []
    for text in texts:
        try:
            expected.append(list(read_hex(text)))
        except HexError:
            expected.append(None)
    replies = ask(reference("busservo").model, [{"ask": "hex", "text": text} for text in texts])
    assert [each if isinstance(each, list) else None for each in replies] == expected
