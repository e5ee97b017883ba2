"""Rule: every example decodes to its values, and they encode to it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any, Literal

from framegen.checks.rule import ModelRule, Problem
from framegen.language.values import to_hex
from framegen.model.codec import NotAFrame, decode, encode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Example
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.messages.items():
        for index, example in enumerate(message.message.examples):
            path = ("messages", name, "examples", index)
            yield from _executed(model, message, example, path)


def _executed(
    model: Model, message: MessageLayout, example: Example, path: KeyPath
) -> Iterator[Problem]:
    try:
        decoded = decode(model, message.direction, example.hex)
    except NotAFrame as error:
        what = f"this is no frame of {message.name}: {error}"
        yield Problem((*path, "hex"), what, partial(_other_order, model, message, example))
        return
    if decoded.layout is not message:
        at, found = message.frame.id_at, decoded.layout
        text = f"this is a frame of {found.name}: byte {at} is {found.id}, not {message.id}"
        yield Problem((*path, "hex"), text)
        return
    differences = list(_differences((*path, "values"), decoded.values, example.values, message))
    yield from differences
    again = encode(model, message, decoded.values)
    if again != example.hex:
        yield Problem((*path, "hex"), f"its values encode to {to_hex(again)}, which is not this")


def _other_order(model: Model, message: MessageLayout, example: Example) -> str:
    """Hint at the byte order, if the frame would have its values in the other one."""
    order: Literal["little", "big"] = "big" if model.spec.byte_order == "little" else "little"
    other = replace(model, spec=model.spec.model_copy(update={"byte_order": order}))
    try:
        decoded = decode(other, message.direction, example.hex)
    except NotAFrame:
        return ""
    right = decoded.layout is message and decoded.values == example.values
    return f"bytes swapped? with `byte_order: {order}`, it has these values" if right else ""


def _differences(path: KeyPath, frame: Any, said: Any, message: MessageLayout) -> Iterator[Problem]:
    if isinstance(frame, dict) and isinstance(said, dict):
        for key in [key for key in frame if key not in said]:
            yield Problem(path, f"the frame has `{key}`, and the values leave it out")
        for key, value in said.items():
            if key in frame:
                yield from _differences((*path, key), frame[key], value, message)
            else:
                counts = message.repeat is not None and key == message.repeat.counter.name
                hint = "leave it out: the list says it" if counts else "leave it out"
                yield Problem((*path, key), f"the frame gives no `{key}`", hint, on_key=True)
    elif isinstance(frame, list) and isinstance(said, list):
        if len(frame) != len(said):
            yield Problem(path, f"{len(said)} are listed, and the frame has {len(frame)}")
        for index, (value, other) in enumerate(zip(frame, said, strict=False)):
            yield from _differences((*path, index), value, other, message)
    elif frame != said or type(frame) is not type(said):
        hint = "bytes swapped?" if _swapped(path, frame, said, message) else ""
        yield Problem(path, f"the frame says {_shown(frame)}, not {_shown(said)}", hint)


def _swapped(path: KeyPath, frame: Any, said: Any, message: MessageLayout) -> bool:
    """Whether the frame has the bytes of the number the other way round."""
    _, _, _, _, _, *steps = path
    in_list = message.repeat is not None and steps[0] == message.repeat.name
    fields = message.repeat.fields if in_list and message.repeat is not None else message.numbers
    name = [step for step in steps if isinstance(step, str)][-1]
    wire = next((field.wire for field in fields if field.name == name), None)
    if wire is None or type(said) is not int or not wire.low <= said <= wire.high:
        return False
    signed = wire.low < 0
    there = said.to_bytes(wire.size, "big", signed=signed)
    return type(frame) is int and int.from_bytes(there, "little", signed=signed) == frame


def _shown(value: object) -> str:
    if isinstance(value, list | dict):
        return "a list" if isinstance(value, list) else "an element"
    if value is None:
        return "nothing"
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return text if len(text) <= 40 else text[:40] + "..."


RULE = ModelRule(
    id="example",
    title="Every example decodes to its values, and they encode to it",
    why="Examples are the evidence for everything else: a layout that does not read them is wrong, "
    "or they are.",
    bad="{hex: AA 55 02 01 64, values: {percent: 50}}",
    good="{hex: AA 55 02 01 32, values: {percent: 50}}",
    look=_look,
)
