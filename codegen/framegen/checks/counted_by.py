"""Rule: every list is counted by an earlier number that does nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import ListField, NumberField
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import AnyField, Message, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            here = ("messages", name, "fields", field_name)
            if isinstance(field, ListField):
                yield from _in_element(here, field)
            if field.counted_by is not None:
                path = (*here, "counted_by")
                yield from _counter(path, name, message, field_name, field.counted_by)
            elif field.count is not None:
                yield Problem(
                    (*here, "count"),
                    f"`{field_name}` is one number, not a list",
                    "add `counted_by`, or remove `count`",
                    on_key=True,
                )


def _in_element(path: KeyPath, group: ListField) -> Iterator[Problem]:
    for name, field in group.fields.items():
        for key in ("counted_by", "count"):
            if getattr(field, key) is not None:
                yield Problem(
                    (*path, "fields", name, key),
                    f"`{name}` is inside an element, where there can be no list",
                    f"remove `{key}`",
                    on_key=True,
                )


def _counter(
    path: KeyPath, name: str, message: Message, field_name: str, counter_name: str
) -> Iterator[Problem]:
    fields = message.fields
    earlier = list(fields)[: list(fields).index(field_name)]
    plain = [key for key in earlier if _plain(fields[key])]
    if counter_name not in fields:
        hint = did_you_mean(counter_name, plain)
        yield Problem(path, f"{name} has no field `{counter_name}`", hint)
    elif counter_name not in plain:
        what = (
            "is no unsigned number"
            if counter_name in earlier
            else "does not stand before the list that it counts"
        )
        yield Problem(
            path, f"`{counter_name}` {what}", also=((*path[:3], counter_name), "it is here")
        )
    else:
        yield from _busy((*path[:3], counter_name), counter_name, fields[counter_name])


def _plain(field: AnyField) -> bool:
    """Tell whether a field is an unsigned number; an unknown type is another rule's concern."""
    if not isinstance(field, NumberField) or field.counted_by is not None:
        return False
    type_ = NUMBER_TYPES.get(field.type)
    return type_ is None or type_.low == 0


def _busy(path: KeyPath, name: str, field: AnyField) -> Iterator[Problem]:
    for key in ("range", "scale", "values", "limits", "signed_as"):
        if getattr(field, key, None):
            yield Problem(
                (*path, key),
                f"`{name}` is a count, which has no `{key}` of its own",
                "bound it with `count` at the list" if key == "range" else f"remove `{key}`",
                on_key=True,
            )


RULE = StructureRule(
    id="counted-by",
    title="Every list is counted by an earlier number that does nothing else",
    why="A decoder reads from front to back: it must know how many elements come before the first. "
    "The encoder works the count out, so it can carry no other meaning.",
    bad="{lamps: {type: u8, counted_by: lamp_cuont}, lamp_count: {type: u8}}",
    good="{lamp_count: {type: u8}, lamps: {type: u8, counted_by: lamp_count}}",
    look=_look,
)
