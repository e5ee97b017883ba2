"""Rule: every type is one that the language has."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from framegen.checks.frames import parts
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import ALL_TYPES, NUMBER_TYPES
from framegen.language.other_words import other_type
from framegen.language.spec import ListField
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, type_ in _types(spec):
        if type_ not in ALL_TYPES:
            hint = other_type(type_) or partial(did_you_mean, type_, NUMBER_TYPES)
            yield Problem(path, f"unknown type `{type_}`", hint)


def _types(spec: Spec) -> Iterator[tuple[KeyPath, str]]:
    for path, part in parts(spec):
        type_ = getattr(part, "type", None)
        if type_ is not None:
            yield (*path, "type"), type_
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            here = ("messages", name, "fields", field_name)
            if isinstance(field, ListField):
                for inner_name, inner in field.fields.items():
                    yield (*here, "fields", inner_name, "type"), inner.type
            else:
                yield (*here, "type"), field.type


RULE = StructureRule(
    id="unknown-type",
    title="Every type is one that the language has",
    why="A type that does not exist has no size, so no later field would have a place.",
    bad="time_ms: {type: v16}",
    good="time_ms: {type: u16}",
    look=_look,
)
