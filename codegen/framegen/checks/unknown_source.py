"""Rule: every cited source is declared."""

from __future__ import annotations

from functools import cache, partial
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from framegen.checks.rule import Problem, StructureRule
from framegen.language.values import Citation
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    cited = [(("protocol", "authority"), spec.protocol.authority), *_cited((), spec)]
    for path, source in cited:
        if source not in spec.sources:
            other = "declare it under `sources`"
            hint = partial(did_you_mean, source, spec.sources, otherwise=other)
            yield Problem(path, f"there is no source `{source}`", hint)


# What a citation is, or may be in; most values are texts and numbers.
_CITING = (Citation, BaseModel, dict, list)


def _cited(path: KeyPath, value: Any) -> Iterator[tuple[KeyPath, str]]:
    """Find the citations in `value`, wherever the language allows one."""
    if isinstance(value, Citation):
        yield path, value.source
        return
    inner: Iterable[tuple[str | int, Any]] = ()
    if isinstance(value, BaseModel):
        inner = ((key, getattr(value, name)) for key, name in _keys(type(value)))
    elif isinstance(value, dict):
        inner = ((str(key), item) for key, item in value.items())
    elif isinstance(value, list):
        inner = enumerate(value)
    for step, item in inner:
        if isinstance(item, _CITING):
            yield from _cited((*path, step), item)


@cache
def _keys(model: type[BaseModel]) -> list[tuple[str, str]]:
    """Return the keys that something in a spec may have, each with its name in the code."""
    return [(info.alias or name, name) for name, info in model.model_fields.items()]


RULE = StructureRule(
    id="unknown-source",
    title="Every cited source is declared",
    why="A fact is only as good as its source, and readers cannot look up one that is not "
    "declared.",
    bad="cite: vender, section 1.1",
    good="cite: vendor, section 1.1",
    look=_look,
)
