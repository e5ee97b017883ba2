"""Type checkers find nothing in what is generated: libraries, and the types of JavaScript modules.

tests/world/test_protocols.py has the libraries of protocols that others made.
"""

import json
from pathlib import Path

import pytest
from framegen.site.scripts.javascript_module import javascript_module

from tests.contract.test_demo_library import many
from tests.factories import compiled_file, write_files
from tests.programs import ran
from tests.side_by_side import type_checked
from tests.unit.site.reference import NODE, NODE_MODULES
from tests.unit.site.test_javascript_module import SPECS
from tests.unit.targets.test_names import CROWDS, files_of_crowd

COMPILER = NODE_MODULES / "typescript" / "bin" / "tsc"


def test_nothing_is_found_in_libraries_of_every_shape(tmp_path: Path) -> None:
    for made in many().values():
        write_files(made, tmp_path)
    assert type_checked(tmp_path / "generated", tmp_path / "cache") == {}


def test_nothing_is_found_in_libraries_with_odd_names(tmp_path: Path) -> None:
    for name in CROWDS:
        write_files(files_of_crowd(name), tmp_path)
    assert type_checked(tmp_path / "generated", tmp_path / "cache") == {}


# Right uses of the types, and wrong ones, each of which is marked and has to be refused.
TYPED = """
import { StreamDecoder, decode, encode, explain } from "./busservo.mjs";
import type { Message, StreamEvent } from "./busservo.mjs";

export function positions(event: StreamEvent): number[] {
  if (event.type !== "message") return [event.refusedAt];
  switch (event.message) {
    case "ServoMove": return event.fields.targets.map(({ position }) => position);
    case "BatteryVoltage": return [event.fields.voltage_mv];
    // @ts-expect-error no message has this name
    case "ServoMoved": return [];
    default: return [event.size];
  }
}

export const frame: Uint8Array = encode("ActionGroupRun", { group: 1, times: "unlimited" });
// @ts-expect-error a value has no such name
encode("ActionGroupRun", { group: 1, times: "often" });
// @ts-expect-error a field is missing
encode("ServoMove", { time_ms: 1 });
// @ts-expect-error a field is a number
encode("ServoMove", { time_ms: "soon", targets: [] });
// @ts-expect-error there is no such direction
new StreamDecoder({ direction: "sideways" });
// @ts-expect-error what was refused has no fields until it is known not to be
decode(frame).fields;

const found = decode(frame, "host_to_controller");
export const named: Message | string = found.type === "refused" ? found.reason : found;
export const why: string = explain([1, 2, 3]).refusals.map(({ expected }) => expected).join();
for (const event of new StreamDecoder().feed([0x55])) console.log(positions(event));
"""
SETTINGS = {
    "compilerOptions": {
        "target": "es2022",
        "module": "nodenext",
        "strict": True,
        "noEmit": True,
        "lib": ["es2022", "dom"],
        "types": [],
    }
}


@pytest.mark.skipif(NODE is None, reason="node is not installed")
@pytest.mark.skipif(
    not COMPILER.exists(), reason="typescript is not installed; `make docs-tools` installs it"
)
def test_types_are_right_for_every_protocol_and_refuse_what_is_wrong(tmp_path: Path) -> None:
    for name, spec in SPECS.items():
        write_files(javascript_module(compiled_file(spec).model), tmp_path / name)
    (tmp_path / "busservo" / "use.mts").write_text(TYPED, encoding="utf-8")
    (tmp_path / "tsconfig.json").write_text(json.dumps(SETTINGS), encoding="utf-8")
    assert ran(NODE, COMPILER, "--project", tmp_path).stdout == ""
