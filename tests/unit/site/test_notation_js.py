"""The words of the command in the page, under node: what is read, and what is refused where."""

from collections.abc import Sequence
from typing import Any

import pytest
from busservo import ActionGroupRun, ActionGroupSpeed, ServoMove, ServoUnload
from framegen.compile import Compiled
from framegen.site.scripts.codec_scripts import codec_scripts
from framegen.site.scripts.protocol_data import protocol_data
from framewire.command.usage_error import UsageError
from framewire.command.values import message_from_text

from tests.factories import compiled_file, compiled_of, data_of, vectors_of
from tests.in_turn import in_turn
from tests.mutations.places import renamed
from tests.protocols.specs import FILES
from tests.unit.site.reference import NODE, reference
from tests.unit.site.scripts import run_script

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

READ = """
const codec = makeCodec(asked.protocol);
const hex = (bytes) => [...bytes].map((byte) => byte.toString(16).padStart(2, "0")).join("");
const answers = asked.texts.map(([name, text]) => {
  const kind = codec.kinds.find((each) => each.name === name);
  try {
    return { hex: hex(codec.encode(name, readNotation(kind, text))) };
  } catch (error) {
    if (!(error instanceof Unusable)) throw error;
    return { message: error.message, at: error.at, size: error.size };
  }
});
"""
WRITE = """
const codec = makeCodec(asked.protocol);
const answers = asked.texts.map(([name, hex]) => {
  const kind = codec.kinds.find((each) => each.name === name);
  const bytes = Uint8Array.from(hex.match(/../g), (each) => parseInt(each, 16));
  return writeNotation(kind, codec.decodeFrame(bytes, kind.direction).fields);
});
"""
MESSAGES = (ServoMove, ActionGroupRun, ActionGroupSpeed, ServoUnload)
KINDS = {each.__name__: each for each in MESSAGES}
# Words that the command takes, with the frame that they make.
GOOD = [
    ("ServoMove", "time_ms=800 targets=1:600,2:400"),
    ("ServoMove", "targets=1:600  time_ms=0x320"),
    ("ServoMove", "time_ms=0b11 targets=0o7:0x10"),
    ("ActionGroupRun", "group=8 times=unlimited"),
    ("ActionGroupRun", "group=8 times=0"),
    ("ActionGroupSpeed", "group=all percent=50"),
    ("ServoUnload", "servo_ids=1,2,0x03"),
]
# Words that it refuses, and the part that is wrong.
BAD = [
    ("ServoMove", "time_ms=800 targets=1:2:3", "1:2:3"),
    ("ServoMove", "time_ms=800 targets=1:2,3:4:5", "3:4:5"),
    ("ServoMove", "time_ms=800 targets=1:800,,2:3", ""),
    ("ServoMove", "time_ms=800 targets=1:800,", ""),
    ("ServoMove", "time_ms=800 targets=1:800, 2:3", ""),
    ("ServoMove", "time_ms=1e3 targets=1:800", "1e3"),
    ("ServoMove", "time_ms=+5 targets=1:800", "+5"),
    ("ServoMove", "time_ms=007 targets=1:800", "007"),
    ("ServoMove", "time_ms=8.0 targets=1:800", "8.0"),
    ("ServoMove", "time_ms=800 targets=1", "1"),
    ("ServoMove", "time_ms=800 targets=1:", ""),
    ("ServoMove", "time_ms= targets=1:800", ""),
    ("ServoMove", "time_ms targets=1:800", "time_ms"),
    ("ServoMove", "time=800 targets=1:800", "time"),
    ("ServoMove", "time_ms=1 time_ms=2 targets=1:800", "time_ms=2"),
    ("ServoMove", "time_ms=1", ""),
    ("ActionGroupRun", "group=8 times=Unlimited", "Unlimited"),
    ("ActionGroupRun", "group=8 times=forever", "forever"),
    ("ServoUnload", "servo_ids=1:2", "1:2"),
]
# Numbers that no frame can carry: the codec says which.
OUTSIDE = [
    ("ServoMove", "time_ms=800 targets=1:800,2:70000", "targets[1].position: 70000 is outside"),
    ("ServoMove", "time_ms=-1 targets=1:800", "time_ms: -1 is outside"),
    ("ServoUnload", "servo_ids=256", "servo_ids[0]: 256 is outside"),
]


def asked(compiled: Compiled, program: str, texts: Sequence[tuple[str, str]]) -> Any:
    scripts = [*codec_scripts(compiled.model), "capture_place", "notation"]
    data = {"protocol": protocol_data(compiled.model), "texts": texts}
    return run_script(scripts, program, data)


def is_read_back(compiled: Compiled) -> None:
    """Have each frame among the vectors written and read."""
    valid = vectors_of(compiled)["valid"]
    names = [each["message"] for each in valid]
    frames = [each["hex"].replace(" ", "").lower() for each in valid]
    written = asked(compiled, WRITE, [*zip(names, frames, strict=True)])
    answers = asked(compiled, READ, [*zip(names, written, strict=True)])
    assert [each.get("hex", each) for each in answers] == frames


def test_what_the_command_takes_makes_the_same_frame() -> None:
    answers = asked(reference("busservo").compiled, READ, GOOD)
    for (name, text), answer in zip(GOOD, answers, strict=True):
        expected = message_from_text(KINDS[name], text.split())
        assert answer == {"hex": expected.encode().hex()}, text


def test_what_the_command_refuses_is_refused_at_its_place() -> None:
    answers = asked(reference("busservo").compiled, READ, [(name, text) for name, text, _ in BAD])
    for (name, text, wrong), answer in zip(BAD, answers, strict=True):
        with pytest.raises(UsageError):
            message_from_text(KINDS[name], text.split())
        assert "message" in answer, text
        assert text[answer["at"] : answer["at"] + answer["size"]] == wrong, text


def test_numbers_that_no_frame_carries_are_named_with_their_bounds() -> None:
    asking = [(name, text) for name, text, _ in OUTSIDE]
    answers = asked(reference("busservo").compiled, READ, asking)
    for (_, text, said), answer in zip(OUTSIDE, answers, strict=True):
        assert answer["message"].startswith(said), text


@in_turn("name", lambda: ["busservo", "everything"])
def test_what_is_written_is_read_back(name: str) -> None:
    compiled = reference(name).compiled if name == "busservo" else compiled_file(FILES[name])
    is_read_back(compiled)


def test_a_name_that_every_object_of_a_script_has_is_a_name_like_others() -> None:
    data = data_of(FILES["everything"])
    for name in ("sequence", "second", "mode", "idle", "voltage"):
        data = renamed(data, name, "constructor")
    changed = compiled_of(data)
    assert [finding.message for finding in changed.findings] == []
    is_read_back(changed)
    # What is not given is not there, though every object has something of that name.
    strange = [("Flags", "error=constructor mode=1 position=1 temperature=1")]
    (answer,) = asked(compiled_file(FILES["everything"]), READ, strange)
    assert answer["message"].startswith("error: “constructor” is no number")
