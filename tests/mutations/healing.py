"""Lengths and examples derived from the rest of a spec, so that a changed spec stays valid."""

import copy
from typing import Any

from framegen.language.number_types import NUMBER_TYPES
from framegen.model.codec import Unencodable, encode
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.slots import Items, Number, Slot
from framegen.reading.yamltree import Unusable

from tests.factories import Data, compiled_of


def healed(data: Data) -> Data | None:
    """Return a copy whose lengths and examples are those of its fields; None if it has no layout.

    Facts about single frames are left out: errata, unknowns, examples of look-alikes.
    """
    whole: Data = copy.deepcopy(data)
    try:
        whole |= {"errata": [], "unknowns": []}
        for lookalike in whole.get("lookalikes", {}).values():
            lookalike.pop("examples", None)
        for message in whole["messages"].values():
            message |= {"length": 0, "examples": []}
        model = compiled_of(whole).derived
    except (AttributeError, KeyError, TypeError, Unusable):
        return None
    if model is None:
        return None
    for name, message in model.messages.items():
        whole["messages"][name]["length"] = str(message.formula)
        try:
            whole["messages"][name]["examples"] = list(_examples(model, message))
        except Unencodable:
            return None
    return whole


def _examples(model: Model, message: MessageLayout) -> list[dict[str, Any]]:
    fields = message.numbers_by_path.values()
    shown = [_values(message, number) for number in range(max(map(_many, fields), default=1))]
    said = {"title": "An example", "constructed": "From the layout."}
    return [{**said, "hex": encode(message, each).hex(" "), "values": each} for each in shown]


def _values(message: MessageLayout, number: int) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for slot in message.arguments:
        if isinstance(slot, Number):
            values[slot.name] = _shown(slot, number)
            continue
        assert isinstance(slot, Items)
        many = slot.low if number == 1 else min(slot.high, max(slot.low, 2))
        values[slot.name] = [
            {field.name: _shown(field, number + at) for field in slot.fields}
            if slot.element is not None
            else _shown(slot.fields[0], number + at)
            for at in range(many)
        ]
    return values


def _shown(field: Slot, number: int) -> int:
    assert isinstance(field, Number)
    found = _all_of(field)
    return found[number % len(found)]


def _many(field: Number) -> int:
    return len(_all_of(field)) + 1


def _all_of(field: Number) -> list[int]:
    """Return the values that an example of a field has to show, inside its limits."""
    found = [field.low, field.high, *(each.value for each in field.field.values.values())]
    if field.field.signed_as in NUMBER_TYPES:
        found.append(NUMBER_TYPES[field.field.signed_as].high + 1)
    limits = field.field.limits
    if limits is None:
        return list(dict.fromkeys(found))
    bounds = [limits.usual, *limits.others.values()]
    return [bounds[0].low, *(each.high or 0 for each in bounds)]
