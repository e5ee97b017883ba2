"""Rule: an element of a list holds no other list."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import ListField
from framegen.model.layout import is_constant

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            if isinstance(field, ListField):
                for inner_name, inner in field.fields.items():
                    here = ("messages", name, "fields", field_name, "fields", inner_name)
                    yield from _nested(here, inner_name, inner)


def _nested(path: KeyPath, name: str, field: NumberField) -> Iterator[Problem]:
    for key in ("counted_by", "sized_by"):
        if getattr(field, key) is not None:
            what = f"`{name}` is inside an element, where there can be no list"
            yield Problem((*path, key), what, _BYTES, on_key=True)
            return
    if field.count is not None and field.text is None and not is_constant(field):
        what = f"`{name}` is inside an element, where there can be no list"
        yield Problem((*path, "count"), what, _numbered(name, field), on_key=True)


_WHOLE = (
    "describe the whole list as bytes, `{type: u8, sized_by: ...}`, and take them apart in your "
    "program"
)
_BYTES = f"elements that differ in size cannot be told apart: {_WHOLE}"


def _numbered(name: str, field: NumberField) -> str:
    """Return the fields that say the same as a fixed list."""
    count = field.count
    if count is None or count.low != count.high or not 1 < count.low <= _MOST:
        return f"if it is text, add `text: ascii`; else {_WHOLE}"
    each = ", ".join(f"{name}_{number}" for number in range(1, count.low + 1))
    return f"give each a field of its own: {each}"


# More than that nobody writes out.
_MOST = 4

RULE = StructureRule(
    id="nested-list",
    title="An element of a list holds no other list",
    why="An element has the same size wherever it stands, so that the number of elements follows "
    "from the size of the frame. Text of a fixed size may stand inside.",
    bad="lamps: {element: Lamp, fields: {levels: {type: u8, count: 2}}}",
    good="lamps: {element: Lamp, fields: {level_1: {type: u8}, level_2: {type: u8}}}",
    look=_look,
)
