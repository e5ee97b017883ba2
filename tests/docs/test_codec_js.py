"""The codec in the page, under node: as the published vectors have it, and as Python has it."""

import json
import subprocess
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from busservo.hextext import HexError, read_hex

from tests.docs.peers import library, noisy_lines, python_events, python_verdict, vectors_of
from tests.docs.reference import NODE, ROOT, SPECS, reference
from tests.hex_cases import HEX, NO_HEX, random_texts

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

# Runs the scripts of the page as they are published, on questions from standard input.
HARNESS = """
const { protocol, questions } = JSON.parse(require("fs").readFileSync(0, "utf8"));
const codec = makeCodec(protocol);
const hex = (bytes) => bytes.map((byte) => byte.toString(16).padStart(2, "0")).join("");
const answers = questions.map(({ ask, hex: text, direction, message, fields }) => {
  if (ask === "hex") {
    try { return parseHex(text); } catch (error) { return { refused: error instanceof Unusable }; }
  }
  if (ask === "encode") {
    try { return hex(codec.encode(message, fields)); }
    catch (error) { if (error instanceof Unusable) return { error: error.message }; throw error; }
  }
  if (ask === "frame") {
    const found = codec.decodeFrame(parseHex(text), direction);
    return found.message ? { message: found.message, fields: found.fields }
      : { reason: found.reason, offset: found.offset };
  }
  return codec.decodeStream(parseHex(text), direction).map((event) =>
    [event.type, hex(event.bytes), event.message || event.reason]);
});
console.log(JSON.stringify(answers));
"""

WAYS = {name: [way.key for way in reference(name).model.directions] for name in SPECS}


def ask(name: str, questions: list[dict[str, Any]]) -> list[Any]:
    """What the scripts of the page answer to each question."""
    scripts = reference(name).pages["decoder.html"].scripts
    (data,) = [text for given, text in scripts if given.get("type") == "application/json"]
    (codec,) = [text for _, text in scripts if "function makeCodec" in text]
    done = subprocess.run(
        [str(NODE), "--input-type=commonjs", "-e", codec + HARNESS],
        input=json.dumps({"protocol": json.loads(data), "questions": questions}),
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    answers: list[Any] = json.loads(done.stdout)
    return answers


@cache
def module(name: str, folder: Path) -> ModuleType:
    return library(name, folder)


@pytest.fixture(params=SPECS, scope="module")
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="module")
def peer(name: str, tmp_path_factory: pytest.TempPathFactory) -> ModuleType:
    return library(name, tmp_path_factory.mktemp(name))


def test_valid_vectors_are_decoded_and_encoded(name: str) -> None:
    valid = vectors_of(reference(name))["valid"]
    decoded = ask(
        name, [{"ask": "frame", "hex": v["hex"], "direction": v["direction"]} for v in valid]
    )
    assert decoded == [{"message": v["message"], "fields": v["fields"]} for v in valid]
    encoded = ask(
        name, [{"ask": "encode", "message": v["message"], "fields": v["fields"]} for v in valid]
    )
    assert encoded == [v["hex"].replace(" ", "").lower() for v in valid]


def test_invalid_vectors_are_refused_for_the_right_reason_at_the_right_byte(name: str) -> None:
    invalid = vectors_of(reference(name))["invalid"]
    refused = ask(
        name, [{"ask": "frame", "hex": v["hex"], "direction": v["direction"]} for v in invalid]
    )
    assert refused == [{"reason": v["reason"], "offset": v["offset"]} for v in invalid]


@pytest.mark.parametrize("seed", range(3))
def test_noisy_streams_are_decoded_as_python_decodes_them(
    name: str, peer: ModuleType, seed: int
) -> None:
    lines = [
        (line, way)
        for line in noisy_lines(reference(name), seed, 500)
        for way in (None, *WAYS[name])
    ]
    questions = [{"ask": "stream", "hex": line.hex(), "direction": way} for line, way in lines]
    for (line, way), answer in zip(lines, ask(name, questions), strict=True):
        assert answer == python_events(peer, line, way), f"{way}: {line.hex(' ')}"


def test_noisy_lines_as_single_frames_get_the_verdict_of_python(
    name: str, peer: ModuleType
) -> None:
    lines = [
        (line, way) for line in noisy_lines(reference(name), 9, 400) for way in (None, *WAYS[name])
    ]
    questions = [{"ask": "frame", "hex": line.hex(), "direction": way} for line, way in lines]
    for (line, way), answer in zip(lines, ask(name, questions), strict=True):
        said = ["message", answer["message"]] if "message" in answer else [*answer.values()]
        assert said == python_verdict(peer, line, way), f"{way}: {line.hex(' ')}"


def test_a_recorded_line_is_decoded_as_python_decodes_it(peer: ModuleType, name: str) -> None:
    line = (ROOT / "tests" / "captures" / "noisy_line.bin").read_bytes()
    for way in (None, *WAYS[name]):
        question = {"ask": "stream", "hex": line.hex(), "direction": way}
        assert ask(name, [question]) == [python_events(peer, line, way)]


def test_unknown_frames_are_shown_and_never_swallow_what_follows() -> None:
    questions = [
        {"ask": "stream", "hex": "55 55 04 63 01 02 55 55 02 07", "direction": WAYS["busservo"][0]},
        {"ask": "stream", "hex": "55 55 FF 55 55 02 07", "direction": WAYS["busservo"][0]},
    ]
    assert ask("busservo", questions) == [
        [
            ["unknown", "555504630102", "unknown command"],
            ["message", "55550207", "ActionGroupStop"],
        ],
        [["noise", "5555ff", "unknown command"], ["message", "55550207", "ActionGroupStop"]],
    ]


@pytest.mark.parametrize(
    ("fields", "error"),
    [
        ({"time_ms": 65536, "targets": [{"servo_id": 1, "position": 2}]}, "time_ms: 65536 is out"),
        (
            {"time_ms": 1, "targets": [{"servo_id": 1, "position": 70000}]},
            "targets[0].position: 70000 is outside 0..65535",
        ),
        ({"time_ms": 1, "targets": []}, "targets: 0 items is outside 1..83"),
        ({"time_ms": 1.5, "targets": [{"servo_id": 1, "position": 2}]}, "time_ms: a whole number"),
        ({"time_ms": 1, "targets": [{"servo_id": 1}]}, "targets[0].position: a whole number"),
    ],
)
def test_values_that_no_frame_can_carry_are_refused(fields: dict[str, Any], error: str) -> None:
    (answer,) = ask("busservo", [{"ask": "encode", "message": "ServoMove", "fields": fields}])
    assert answer["error"].startswith(error)


def test_hex_is_read_as_the_library_reads_it() -> None:
    texts = [text for text, _ in HEX] + NO_HEX + random_texts(1000)
    expected: list[Any] = []
    for text in texts:
        try:
            expected.append(list(read_hex(text)))
        except HexError:
            expected.append({"refused": True})
    assert ask("busservo", [{"ask": "hex", "hex": text} for text in texts]) == expected
