"""Rule: text is a list of bytes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.fields import numbers
from framegen.checks.rule import Problem, StructureRule
from framegen.model.layout import is_varying

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath

_OWN = ("range", "values", "bits", "limits", "signed_as", "scale")


def _look(spec: Spec) -> Iterator[Problem]:
    for path, field in numbers(spec):
        if field.text is not None:
            yield from _misuse(path, field)


def _misuse(path: KeyPath, field: NumberField) -> Iterator[Problem]:
    name = path[-1]
    if field.type != "u8":
        what = f"text has a byte a character, and `{name}` is of {field.type}"
        yield Problem((*path, "type"), what, "write `type: u8`")
    if field.count is None and not is_varying(field):
        what = f"nothing says how long the text `{name}` is"
        hint = "add `count: 16`, if it is always padded to 16 bytes; or `sized_by`, or `counted_by`"
        yield Problem((*path, "text"), what, hint, on_key=True)
    for other in _OWN:
        if getattr(field, other):
            what = f"`{name}` is text, which has no `{other}`"
            yield Problem((*path, other), what, f"remove `{other}`, or `text`", on_key=True)


RULE = StructureRule(
    id="text-field",
    title="Text is a list of bytes",
    why="Each byte is a character of ASCII. Text of a fixed size is padded with zeros, which are "
    "no part of it.",
    bad="name: {type: u8, text: ascii}",
    good="name: {type: u8, count: 16, text: ascii}",
    look=_look,
)
