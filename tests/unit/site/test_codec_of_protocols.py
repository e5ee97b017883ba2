"""The codec in the page, under node, for frames of every kind: compared with the reference."""

import random
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode, encode, values_of
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data

from tests.protocols.specs import FILES, model_of
from tests.unit.site.peers import Event, joined, noisy_lines
from tests.unit.site.reference import NODE
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

PROGRAM = """
const codec = makeCodec(asked.protocol);
const plain = ({ type, bytes, message, reason, fields }) => (
  [type, Array.from(bytes), message || reason, fields || null]);
function answer(ask, first, second, room) {
  if (ask === "encode") return Array.from(codec.encode(first, second));
  if (ask === "frame") {
    const { message, fields, reason, offset } = codec.decodeFrame(second, first);
    return message ? [message, fields] : [reason, offset];
  }
  const stream = codec.makeStream({ direction: first, maxFrame: room });
  return second.flatMap((part) => (part === null ? stream.flush() : stream.feed(part))).map(plain);
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


def ask(model: Model, questions: list[tuple[Any, ...]]) -> list[Any]:
    """Return the answers of the page's codec."""
    answers: list[Any] = run_script(
        codec_scripts(model), PROGRAM, {"protocol": protocol_data(model), "questions": questions}
    )
    return answers


@cache
def lines_of(name: str) -> list[bytes]:
    return noisy_lines(model_of(name), 12, 100)


def ways_of(model: Model) -> list[tuple[str | None, list[Direction]]]:
    """Return each direction, and all together, as the page and as the reference take them."""
    return [*((way.key, [way]) for way in model.directions), (None, model.directions)]


@pytest.mark.each_protocol
@pytest.mark.parametrize("name", FILES)
def test_streams_are_decoded_as_the_reference_decodes_them(name: str) -> None:
    model, chance = model_of(name), random.Random(name)  # noqa: S311 - the same in every run
    questions: list[tuple[Any, ...]] = []
    expected: list[list[Event]] = []
    least = min(frame.least for frame in model.envelopes.values())
    for line in lines_of(name):
        for key, ways in ways_of(model):
            largest = model.largest(ways)
            room = max(least, chance.choice([largest, largest, 20, 8, least]))
            parts = [*_cut(chance, line)]
            questions.append(("stream", key, parts, room))
            expected.append(joined(_events(model, ways, room, parts)))
    for question, found, right in zip(questions, ask(model, questions), expected, strict=True):
        said = [[kind, bytes(data).hex(), (what, values)] for kind, data, what, values in found]
        assert joined(said) == right, question


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
            continue
        if event.message is None:
            yield [event.kind, event.data.hex(), (event.reason, None)]
        else:
            values = values_of(event.message, event.data)
            yield [event.kind, event.data.hex(), (event.message.name, values)]


@pytest.mark.each_protocol
@pytest.mark.parametrize("name", FILES)
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


@pytest.mark.each_protocol
@pytest.mark.parametrize("name", FILES)
def test_every_example_is_encoded_as_the_reference_encodes_it(name: str) -> None:
    model = model_of(name)
    examples = [
        (message, example.values)
        for message in model.messages.values()
        for example in message.message.examples
    ]
    found = ask(model, [("encode", each.name, whole(each, values)) for each, values in examples])
    assert found == [list(encode(each, values)) for each, values in examples]


def whole(message: MessageLayout, values: dict[str, Any]) -> dict[str, Any]:
    """Return the values of an example, with null for each field that is absent."""
    absent: dict[str, Any] = {slot.name: None for slot in message.optional}
    return absent | values


# Values that no frame can carry, by protocol and message, and how the refusal begins.
UNUSABLE: list[tuple[str, str, dict[str, Any], str]] = [
    ("lxservo", "Move", {"servo_id": 255}, "servo_id: 255 is outside 0..254"),
    ("lxservo", "Move", {"servo_id": 1.5}, "servo_id: a whole number is due"),
    ("sbus", "Channels", {"channels": [0] * 15}, "channels: 15 numbers, and it has 16"),
    ("sbus", "Channels", {"channels": [2048] * 16}, "channels[0]: 2048 is outside 0..2047"),
    (
        "mavlink1",
        "ParameterRead",
        {"name": 17 * "a"},
        "name: 17 characters, and it has room for 16",
    ),
    ("mavlink1", "ParameterRead", {"name": "é"}, "name: “é” is not ASCII"),
    ("mavlink1", "Parameter", {"value": 1e39}, "value: 1e+39 does not fit"),
    (
        "mavlink1",
        "SystemTime",
        {"unix_us": 1 << 64},
        f"unix_us: {1 << 64} is outside 0..{(1 << 64) - 1}",
    ),
    ("modbus", "Holding", {"registers": []}, "registers: 0 items is outside 1..125"),
]


@pytest.mark.parametrize(("name", "message", "wrong", "refusal"), UNUSABLE)
def test_values_that_no_frame_can_carry_are_refused(
    name: str, message: str, wrong: dict[str, Any], refusal: str
) -> None:
    model = model_of(name)
    values = model.messages[message].message.examples[0].values
    (found,) = ask(model, [("encode", message, {**values, **wrong})])
    assert found["refused"] == refusal
