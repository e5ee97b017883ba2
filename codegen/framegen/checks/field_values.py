"""The values that a number of a spec may have, before there is a model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import ListField
from framegen.language.values import Range

if TYPE_CHECKING:
    from framegen.language.spec import AnyField, Message


def values_at(message: Message, path: str) -> Range | None:
    """Return the values of a field by its path, `level` or `lamps.level`; None if unknown."""
    outer, _, inner = path.partition(".")
    field = message.fields[outer]
    return values_of(field.fields[inner] if isinstance(field, ListField) else field)


def values_of(number: AnyField) -> Range | None:
    """Return the values that a number may have; None where its type is unknown, or a list."""
    if isinstance(number, ListField):
        return None
    type_ = NUMBER_TYPES.get(number.type)
    if type_ is None:
        return None
    low, high = type_.low, type_.high
    if number.range is not None:
        low = number.range.low
        high = high if number.range.high is None else number.range.high
    return Range(low, high)
