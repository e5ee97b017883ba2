"""Rule: every cited source is declared."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from framegen.checks.rule import Problem, StructureRule
from framegen.language.values import Citation
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    cited = [(("protocol", "authority"), spec.protocol.authority), *_cited((), spec)]
    for path, source in cited:
        if source not in spec.sources:
            other = "declare it under `sources`"
            hint = partial(did_you_mean, source, spec.sources, otherwise=other)
            yield Problem(path, f"there is no source `{source}`", hint)


def _cited(path: KeyPath, value: Any) -> Iterator[tuple[KeyPath, str]]:
    """Find the citations in `value`, wherever the language allows one."""
    if isinstance(value, Citation):
        yield path, value.source
    elif isinstance(value, BaseModel):
        for name, info in type(value).model_fields.items():
            yield from _cited((*path, info.alias or name), getattr(value, name))
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from _cited((*path, str(key)), item)
    elif isinstance(value, list):
        for index, item in enumerate(value):
            yield from _cited((*path, index), item)


RULE = StructureRule(
    id="unknown-source",
    title="Every cited source is declared",
    why="A fact is only as good as its source, and readers cannot look up one that is not "
    "declared.",
    bad="cite: vender, section 1.1",
    good="cite: vendor, section 1.1",
    look=_look,
)
