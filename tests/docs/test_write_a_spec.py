"""The guide to the spec language: its example is a spec, and no key of the language is left out."""

import re
from typing import get_args

import pytest
from framegen.compile import compile_spec
from framegen.explain import explain
from framegen.language import spec
from framegen.language.number_types import NUMBER_TYPES
from framegen.reading.source import Source
from framegen.render import render
from pydantic import BaseModel

from tests.docs.reference import ROOT

GUIDE = (ROOT / "docs" / "write-a-spec.md").read_text("utf-8")
BLOCKS = re.findall(r"```yaml\n(.*?)```", GUIDE, re.DOTALL)
SPEC = Source("spec/kiln.yaml", "\n".join(BLOCKS))
MODELS = [
    model
    for model in vars(spec).values()
    if isinstance(model, type) and issubclass(model, BaseModel) and model is not spec.Part
]
KEYS = sorted(
    {
        (model.__name__, info.alias or name)
        for model in MODELS
        for name, info in model.model_fields.items()
    }
)


def test_the_example_is_a_spec_without_findings() -> None:
    assert [finding.render(SPEC) for finding in compile_spec(SPEC).findings] == []


def test_everything_can_be_generated_from_it() -> None:
    compiled = compile_spec(SPEC)
    files = render(compiled).files
    assert "generated/kiln/messages.py" in files
    assert "docs/reference/kiln/messages/ProgramRun.md" in files


@pytest.mark.parametrize(("model", "key"), KEYS)
def test_every_key_is_shown_and_explained(model: str, key: str) -> None:
    prose = re.sub(r"```yaml\n.*?```", "", GUIDE, flags=re.DOTALL)
    assert re.search(rf"^[\s-]*{key}:|[{{ ]{key}: ", SPEC.text, re.MULTILINE), f"{model}.{key}"
    obvious = {"title", "messages", "sources", "protocol", "link", "history", "changes", "text"}
    assert f"`{key}`" in prose or key in obvious, f"{model}.{key} is not explained"


def test_every_type_and_every_choice_is_named() -> None:
    choices = [
        choice
        for model in MODELS
        for info in model.model_fields.values()
        for choice in get_args(info.annotation)
        if isinstance(choice, str)
    ]
    assert len(choices) > 10
    for word in [*NUMBER_TYPES, *choices]:
        assert f"`{word}`" in GUIDE, word


def test_the_frame_that_the_guide_explains_is_one() -> None:
    compiled = compile_spec(SPEC)
    layout = compiled.model
    (line,) = [line for line in GUIDE.splitlines() if "framegen explain" in line and "AA" in line]
    data = bytes.fromhex(line.partition("kiln.yaml ")[2].partition("`")[0])
    assert explain(layout, data, layout.directions).readings
