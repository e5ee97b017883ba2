"""Floating-point numbers in answers: however a language prints them, they are compared by value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.model.slots import Items, Number

if TYPE_CHECKING:
    from framegen.model.model import Model
    from framegen.model.slots import Field


def with_plain_fractions(model: Model, line: str) -> str:
    """Return a line of an answer with such numbers as the reference writes them."""
    words = line.split(" ")
    message = model.messages.get(words[1]) if len(words) > 3 else None
    if words[0] != "message" or message is None:
        return line
    slots = {slot.name: slot for slot in message.arguments}
    for at, word in enumerate(words[3:], 3):
        name, _, text = word.partition("=")
        if name in slots:
            words[at] = f"{name}={_plain(slots[name], text)}"
    return " ".join(words)


def _plain(slot: Field, text: str) -> str:
    if not isinstance(slot, Items):
        return _number(slot, text)
    items = [item.split(":") for item in text.split(",")]
    return ",".join(
        ":".join(_number(*pair) for pair in zip(slot.fields, item, strict=False))
        if len(item) == len(slot.fields)
        else ":".join(item)
        for item in items
    )


def _number(slot: Field, text: str) -> str:
    if not isinstance(slot, Number) or not slot.is_float:
        return text
    try:
        return repr(slot.value(slot.write(float(text))))
    except (ValueError, OverflowError):
        return text
