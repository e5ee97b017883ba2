"""The guide to the spec language: its example is a spec, and no key of the language is left out."""

import re
from typing import get_args

from framegen.checks import remarks
from framegen.compile import compile_spec
from framegen.explain import explain
from framegen.language import spec
from framegen.language.number_types import ALL_TYPES, NUMBER_TYPES
from framegen.model.checksums import CHECKSUMS
from framegen.model.codec import decode
from framegen.reading.source import Source
from framegen.render import render
from pydantic import BaseModel

from tests.guide_specs import BLOCKS, GUIDE, SPECS
from tests.in_turn import in_turn
from tests.mutations.spec_edits import edited

SPEC = SPECS["kiln"]
# The remarks that the guide shows, by spec.
REMARKS = {"gauges": re.findall(r"```text\n(chance-prefix: .*?)```", GUIDE, re.DOTALL)}
ALL = "\n".join(spec.text for spec in SPECS.values())
CLASSES = [each for each in vars(spec).values() if isinstance(each, type) and each is not spec.Part]
FIELDS = [
    (model.__name__, info.alias or name, info)
    for model in CLASSES
    if issubclass(model, BaseModel)
    for name, info in model.model_fields.items()
]


@in_turn("name", lambda: ["kiln", "pumps", "gauges"])
def test_an_example_is_a_spec_without_findings_and_other_remarks_than_shown(name: str) -> None:
    compiled = compile_spec(SPECS[name])
    assert [finding.render(SPECS[name]) for finding in compiled.findings] == []
    said = remarks(compiled.model, compiled.tree)
    shown = [f"{each.rule}: {each.message}\n  = hint: {each.hint}\n" for each in said]
    assert shown == REMARKS.get(name, [])
    # It means the same with its first line.
    marked = [f"# {name}.yaml\n{text}" for each, text in BLOCKS if (each or "kiln") == name]
    assert compile_spec(Source("spec.yaml", "\n".join(marked))).findings == []


def test_the_guide_shows_what_is_said_of_a_wrong_checksum() -> None:
    text = edited(SPECS["pumps"].text, ("crc-16/modbus", "crc-16/arc"))
    source = Source("spec/pumps.yaml", text)
    said = next(each for each in compile_spec(source).findings if ".Status." in each.path)
    [shown] = re.findall(r"```text\n(example: .*?)```", GUIDE, re.DOTALL)
    assert shown == f"example: {said.message}\n  = hint: {said.hint}\n"


def test_the_guide_shows_a_frame_that_begins_with_another() -> None:
    [shown] = re.findall(r"some pressures begin with a whole fault, such as `([^`]*)`", GUIDE)
    model = compile_spec(SPECS["gauges"]).model
    way, frame = model.messages["Fault"].direction, bytes.fromhex(shown)
    for size, name in (3, "Fault"), (4, "Pressure"):
        assert decode(model, way, frame[:size]).layout.name == name


def test_the_guide_lists_every_checksum() -> None:
    def row(name: str) -> str:
        method = CHECKSUMS[name]
        types = ", ".join(f"`u{width}`" for width in method.widths)
        return f"| `{name}` | {types} | {method.about} |"

    table = "\n".join(["| `method` | `type` | What |", "|---|---|---|", *map(row, CHECKSUMS)])
    assert f"\n{table}\n" in GUIDE


def test_everything_that_the_table_writes_is_in_the_language() -> None:
    """The right column of what documents say: each method is known, and each type."""
    [table] = re.findall(r"\| Your document says .*?\n\n", GUIDE, re.DOTALL)
    written = "; ".join(re.findall("`([^`]*)`", "".join(re.findall(r"\|([^|]*)\|\n", table))))
    methods = set(re.findall(r"method: ((?:[a-z]+ )*[a-z]+[a-z0-9/-]*)", written))
    assert methods >= {"xor", "inverted sum", "crc-16/modbus", "fletcher-8"}
    assert methods <= set(CHECKSUMS)
    assert set(re.findall(r"type: (\w+)", written)) <= set(ALL_TYPES)
    assert set(re.findall(r"is: (\w+)", written)) == {
        *("constant", "length", "id", "body", "address", "counter", "reserved", "checksum")
    }


def test_everything_can_be_generated_from_it() -> None:
    made = {"generated/kiln/messages.py", "docs/reference/kiln/messages/ProgramRun.md"}
    assert made <= render(compile_spec(SPEC)).files.keys()


@in_turn("model, key", lambda: sorted({each[:2] for each in FIELDS}))
def test_every_key_is_shown_and_explained(model: str, key: str) -> None:
    prose = re.sub(r"```yaml\n.*?```", "", GUIDE, flags=re.DOTALL)
    assert re.search(rf"^[\s-]*{key}:|[{{ ]{key}: ", ALL, re.MULTILINE), f"{model}.{key}"
    obvious = {"title", "messages", "sources", "protocol", "link", "history", "changes", "text"}
    assert f"`{key}`" in prose or key in obvious, f"{model}.{key} is not explained"


def test_every_type_and_every_choice_is_named() -> None:
    choices = [each for *_, info in FIELDS for each in get_args(info.annotation)]
    words = [each for each in choices if isinstance(each, str)]
    assert len(words) > 10
    assert [word for word in [*NUMBER_TYPES, *words] if f"`{word}`" not in GUIDE] == []


def test_the_frame_that_the_guide_explains_is_one() -> None:
    layout = compile_spec(SPEC).model
    (line,) = [line for line in GUIDE.splitlines() if "framegen explain" in line and "AA" in line]
    data = bytes.fromhex(line.partition("kiln.yaml ")[2].partition("`")[0])
    assert explain(layout, data, layout.directions).readings
