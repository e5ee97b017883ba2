"""The JavaScript module: what it exports, used as others use it, and its types."""

import json
import re
from pathlib import Path

import pytest
from framegen.model.model import Model
from framegen.site.scripts.javascript_module import javascript_module

from tests.factories import BUSSERVO, DEMO, write_files
from tests.programs import ran
from tests.protocols.specs import FILES
from tests.unit.site.reference import NODE, ROOT, reference
from tests.unit.site.test_hostile_pages import HOSTILE, hostile

pytestmark = pytest.mark.skipif(NODE is None, reason="node is not installed")

SPECS = {"busservo": BUSSERVO, "demo": DEMO, **FILES}


def run_program(folder: Path, model: Model, program: str) -> str:
    """Run a program that imports the module; return what it prints."""
    write_files(javascript_module(model), folder)
    file = folder / "program.mjs"
    file.write_text(program, encoding="utf-8")
    return ran(NODE, file).stdout


WAYS = "host_to_controller, controller_to_host"
# What a user of the module does, and what comes of it.
USE = """
import * as busservo from "./busservo.mjs";

const { StreamDecoder, Unusable, decode, encode, explain, parseHex, toHex } = busservo;
const decoder = new StreamDecoder({ direction: "host_to_controller" });
const events = [
  ...decoder.feed(parseHex("00 13 55 55 08 03 01 E8")),
  ...decoder.feed(parseHex("03 01 20 03 55 55 04")),
];
const held = [decoder.pending, decoder.position];
events.push(...decoder.flush());
const refused = (task) => {
  try {
    return task();
  } catch (error) {
    return [error instanceof Unusable, error.message, error.path];
  }
};
console.log(JSON.stringify({
  exports: Object.keys(busservo).sort(),
  events: events.map((event) => (event.type === "message" ? event.fields : event.reason)),
  held,
  named: toHex(encode("ActionGroupRun", { group: 1, times: "unlimited" })),
  decoded: decode([0x55, 0x55, 0x02, 0x07]).message,
  refused: decode(parseHex("55 55 09"), null),
  both: explain(parseHex("55 55 05 06 08 01 00")).readings.map(({ message }) => message),
  misuse: [
    refused(() => encode("ServoMove", { time_ms: 70000, targets: [{ servo_id: 1, position: 2 }] })),
    refused(() => encode("ServoMove", { time_ms: 1, target: [] })),
    refused(() => encode("ServoMove", { time_ms: 1 })),
    refused(() => encode("ServoMov")),
    refused(() => new StreamDecoder({ direction: "host" })),
    refused(() => parseHex("55 5G")),
  ],
}));
"""


def test_the_module_does_what_its_types_say(tmp_path: Path) -> None:
    assert json.loads(run_program(tmp_path, reference("busservo").model, USE)) == {
        "exports": [
            *("StreamDecoder", "Unusable", "decode", "encode", "explain", "parseHex"),
            *("protocol", "toHex"),
        ],
        "events": [
            "bad header",
            {"time_ms": 1000, "targets": [{"servo_id": 1, "position": 800}]},
            "too short",
        ],
        "held": [3, 12],
        "named": "55 55 05 06 01 00 00",
        "decoded": "ActionGroupStop",
        "refused": {"type": "refused", "reason": "too short", "offset": 3},
        "both": ["ActionGroupRun", "ActionGroupStarted"],
        "misuse": [
            [True, "time_ms: 70000 is outside 0..65535", "time_ms"],
            [True, "target: no field of ServoMove, which has time_ms, targets", "target"],
            [True, "targets: a list is due", "targets"],
            [True, "ServoMov: no message has this name", "ServoMov"],
            [True, f"host is no direction: there are {WAYS}, and null for any", ""],
            [True, "“G” in “5G” is no hex digit", ""],
        ],
    }


def test_the_guide_shows_what_the_module_does(tmp_path: Path) -> None:
    guide = (ROOT / "docs" / "conformance.md").read_text("utf-8")
    [(program, printed)] = re.findall(r"```js\n(.*?)```\n\n```text\n(.*?)```", guide, re.DOTALL)
    assert run_program(tmp_path, reference("busservo").model, program) == printed


def test_types_name_every_message_and_every_field() -> None:
    model = reference("busservo").model
    types = javascript_module(model)["busservo.d.mts"]
    for message in model.messages.values():
        (body,) = re.findall(rf"interface {message.name}Fields {{(.*?)\n}}", types, re.DOTALL)
        names = re.findall(r"^  (\w+): ", body, re.MULTILINE)
        assert names == [slot.name for slot in message.arguments]


def test_text_of_a_spec_ends_neither_a_comment_nor_a_text(tmp_path: Path) -> None:
    model = hostile().model
    program = 'import { protocol } from "./busservo.mjs";\nconsole.log(JSON.stringify(protocol));\n'
    assert json.loads(run_program(tmp_path, model, program))["title"] == HOSTILE
    types = (tmp_path / "busservo.d.mts").read_text("utf-8")
    comments = [line for line in types.splitlines() if line.strip().startswith("/**")]
    assert len(comments) > len(model.messages)
    assert [line for line in comments if line.count("*/") > 1] == []
    assert "alert" not in re.sub(r"/\*\*.*?\*/", "", types, flags=re.DOTALL)
