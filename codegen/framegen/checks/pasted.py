"""Examples to paste: what a hint offers where a spec lacks one."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from framegen.language.values import to_hex
from framegen.model.codec import Unencodable, encode
from framegen.model.slots import Items, Number, Packed

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.model.layout import MessageLayout
    from framegen.model.slots import Field

# More than that nobody reads in a hint.
_LONGEST = 64


def pasted(message: MessageLayout, values: Mapping[str, Any], title: str) -> str:
    """Return the example of these values as a line of a spec; nothing for what no frame carries."""
    try:
        frame = encode(message, values)
    except Unencodable:
        return ""
    said = _written(dict(values))
    if len(frame) > _LONGEST or "e+" in said or "e-" in said:
        return ""
    shown = to_hex(frame) if len(frame) > 1 else f'"{to_hex(frame)}"'
    made_up = "constructed: From the layout alone."
    return f"- {{title: {title}, hex: {shown}, values: {said}, {made_up}}}"


def lowest(message: MessageLayout) -> dict[str, Any]:
    """Return values of the smallest frame of a message."""
    return {slot.name: _lowest(slot) for slot in message.arguments}


def _lowest(slot: Field) -> Any:
    match slot:
        case Number():
            if slot.optional:
                return None
            return 0.0 if slot.is_float else 0 if slot.holds(0) else slot.low
        case Packed():
            return [slot.low] * slot.count
        case Items():
            if slot.text is not None:
                return "?" * slot.low
            each = {field.name: _lowest(field) for field in slot.fields}
            return [each if slot.element is not None else _bare(each)] * slot.low
        case _:
            return ""


def _bare(element: dict[str, Any]) -> Any:
    (value,) = element.values()
    return value


def changed(values: Mapping[str, Any], outer: str, inner: str | None, value: int) -> dict[str, Any]:
    """Return values with another one for a field, which in a list is that of its first element."""
    given = values[outer]
    if isinstance(given, list):
        first = given[0] if given else None
        if inner is not None and isinstance(first, dict):
            return {**values, outer: [{**first, inner: value}, *given[1:]]}
        return {**values, outer: [value, *given[1:]]}
    return {**values, outer: value}


def _written(value: Any) -> str:
    """Write a value in YAML, in one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {_written(each)}" for key, each in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_written, value)) + "]"
    return json.dumps(value)
