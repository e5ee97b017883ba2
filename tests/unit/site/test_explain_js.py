"""The explanations of the page, under node: word for word those of `framegen explain`."""

import random
from typing import Any

import pytest
from framegen.explain import explain
from framegen.model.model import Model
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data
from framewire.explain.explanation import Row
from hypothesis import settings

from tests.factories import BUSSERVO, compiled_file
from tests.protocols.specs import FILES
from tests.rows import each_protocol
from tests.unit.site.peers import noisy_lines
from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

SPECS = {"busservo": BUSSERVO, **FILES}
PROGRAM = """
const { explain } = makeCodec(asked.protocol);
const hex = (bytes) => toHex(bytes);
const rowsOf = (rows) => rows.map(({ at, bytes, path, role, value, text, meaning }) => (
  [at, hex(bytes), path, role, value, text, meaning]));
const answers = asked.questions.map(([bytes, way]) => {
  const { protocol, readings, refusals, hints } = explain(bytes, way);
  return {
    protocol,
    readings: readings.map((each) => (
      [each.message, each.direction, each.summary, rowsOf(each.rows), each.facts])),
    refusals: refusals.map((each) => (
      [each.direction, each.reason, each.offset, each.expected, rowsOf(each.rows)])),
    hints: hints.map(({ text, frame }) => [text, hex(frame)]),
  };
});
"""


def right(model: Model, data: bytes, way: str | None) -> Any:
    """Return what `framegen explain` says."""
    found = explain(model, data, [each for each in model.directions if way in (None, each.key)])
    return {
        "protocol": found.protocol,
        "readings": [
            [each.message, each.direction, each.summary, _rows(each), [*map(list, each.facts)]]
            for each in found.readings
        ],
        "refusals": [
            [each.direction, each.reason, each.offset, each.expected, _rows(each)]
            for each in found.refusals
        ],
        "hints": [[each.text, _hex(each.frame)] for each in found.hints],
    }


def _rows(of: Any) -> list[Any]:
    return [
        [row.offset, _hex(row.data), row.path, row.role, _value(row), row.text, row.meaning]
        for row in of.rows
    ]


def _hex(data: bytes) -> str:
    return data.hex(" ").upper()


def _value(row: Row) -> Any:
    """Return the value of a row; nan is not equal to itself."""
    return "nan" if row.value != row.value else row.value


def frames_for(model: Model, name: str) -> list[bytes]:
    """Return documented frames, changed ones, frames of look-alikes, and noise."""
    chance = random.Random(name)  # noqa: S311 - the same frames in every run
    facts = model.protocol
    examples = [each.examples for each in facts.messages.values()]
    examples += [each.examples for each in facts.lookalikes.values()]
    documented = [bytes.fromhex(each.hex) for some in examples for each in some]
    # Legal both ways; and of a length that no such message has.
    by_hand = ["55 55 05 06 08 01 00", "55 55 09 03 01 E8 03 01 20 03"] * (name == "busservo")
    found = [b"", *map(bytes.fromhex, by_hand), *documented]
    many = max(1, 4 * settings().max_examples // 100)
    found += [_changed(chance, frame) for frame in documented for _ in range(many)]
    found += [line[: chance.randrange(2, 30)] for line in noisy_lines(model, 3, 30)]
    found += [chance.randbytes(size) for size in range(12)]
    return found


def _changed(chance: random.Random, frame: bytes) -> bytes:
    at = chance.randrange(len(frame))
    front, rest = frame[:at], frame[at + 1 :]
    other = bytes([chance.choice([0, 1, 2, 3, 5, 0x7F, 0xFF, chance.randrange(256)])])
    longer = [front + other + frame[at:], other + frame, frame + frame]
    return chance.choice([front, front + other + rest, front + rest, *longer])


@pytest.mark.parametrize("name", each_protocol(SPECS))
def test_bytes_are_explained_in_the_words_of_the_reference(name: str) -> None:
    model = compiled_file(SPECS[name]).model
    ways = [None, *(each.key for each in model.directions)]
    questions = [(data, way) for data in frames_for(model, name) for way in ways]
    asked = {"protocol": protocol_data(model), "questions": questions}
    answers = run_script(codec_scripts(model), PROGRAM, asked)
    for (data, way), said in zip(questions, answers, strict=True):
        assert said == right(model, data, way), (data.hex(" "), way)
