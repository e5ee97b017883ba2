"""What says how long a list is, for the rules about it: an earlier number, and nothing else."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem
from framegen.language.number_types import ALL_TYPES
from framegen.language.spec import NumberField
from framegen.model.layout import is_constant, is_list
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import AnyField, Message
    from framegen.reading.yamltree import KeyPath

# What a number may say of itself that only a user's own number can.
_OWN = ("range", "scale", "values", "bits", "limits", "signed_as", "optional")


def plain_before(message: Message, field_name: str) -> list[str]:
    """Return the unsigned numbers in front of a field, which could say how long it is."""
    names = list(message.fields)
    return [key for key in names[: names.index(field_name)] if _is_plain(message.fields[key])]


def counter_problems(
    path: KeyPath, name: str, message: Message, field_name: str, counter: str, also: list[str]
) -> Iterator[Problem]:
    """Find what is wrong with the `counter` of a list; what else it could be is `also`."""
    fields = message.fields
    plain = plain_before(message, field_name)
    earlier = list(fields)[: list(fields).index(field_name)]
    if counter not in fields:
        hint = did_you_mean(counter, [*plain, *also], otherwise=_NONE if not plain else "")
        what = f"{name} has no field `{counter}`"
        named = [key for key in earlier if counter in getattr(fields[key], "bits", {})]
        if named:
            what = f"`{counter}` is some bits of `{named[0]}`, and only a whole number counts"
            hint = "write `sized_by` and the length part, for all that is left, or `count` if it "
            hint += "is always as many"
        yield Problem(path, what, hint)
    elif counter not in earlier:
        what = f"`{counter}` does not stand before the list that it counts"
        there = ((*path[:3], counter), "it is here")
        hint = f"move `{counter}` in front of `{field_name}`"
        if counter == field_name:
            hint = f"put what counts it in front, such as `{plain[-1]}`" if plain else _NONE
        yield Problem(path, what, hint, also=there)
    elif counter not in plain:
        there = ((*path[:3], counter), "it is here")
        hint = "give it an unsigned type, such as u8, and nothing but `about`"
        yield Problem(path, f"`{counter}` is no unsigned number", hint, also=there)
    else:
        yield from _busy((*path[:3], counter), counter, fields[counter])


_NONE = "put a number in front of the list, such as `count: {type: u8, about: How many follow.}`"


def _is_plain(field: AnyField) -> bool:
    """Tell whether a field is an unsigned number; an unknown type is another rule's concern."""
    if not isinstance(field, NumberField) or is_list(field) or is_constant(field):
        return False
    type_ = ALL_TYPES.get(field.type)
    unsigned = type_ is None or (type_.low == 0 and not type_.is_packed)
    return unsigned and field.text is None


def _busy(path: KeyPath, name: str, field: AnyField) -> Iterator[Problem]:
    for key in _OWN:
        if getattr(field, key, None):
            yield Problem(
                (*path, key),
                f"`{name}` is a count, which has no `{key}` of its own",
                "bound it with `count` at the list" if key == "range" else f"remove `{key}`",
                on_key=True,
            )
