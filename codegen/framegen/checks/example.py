"""Rule: every example decodes to its values, and they encode to it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from framewire.explain.refusals import BAD_CHECKSUM, UNKNOWN_COMMAND

from framegen.checks.other_checksum import checksum_hint
from framegen.checks.rule import ModelRule, Problem
from framegen.checks.wrong_checksum import other_id, wrong_checksum
from framegen.language.values import to_hex
from framegen.model.codec import NotAFrame, Unencodable, decode, encode
from framegen.model.slots import Constant, Number

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
        # An id proves nothing where a checksum says that it may be another.
        unproven = error.reason == UNKNOWN_COMMAND
        wrong = wrong_checksum(model, message, example.hex) if unproven else ""
        reason = BAD_CHECKSUM if wrong else error.reason
        what = f"this is no frame of {message.name}: {wrong or error}"
        yield Problem((*path, "hex"), what, partial(_hint, model, message, example, reason))
        return
    if decoded.layout is not message:
        yield Problem((*path, "hex"), _other(message, decoded.layout))
        return
    differences = list(_differences((*path, "values"), decoded.values, example.values, message))
    yield from differences
    again = encode(message, decoded.values, example.hex)
    if again != example.hex:
        yield Problem((*path, "hex"), f"its values encode to {to_hex(again)}, which is not this")


def _hint(model: Model, message: MessageLayout, example: Example, reason: str) -> str:
    """Say what would make a frame of an example that is none."""
    data = example.hex
    mended = _other_length(model, message, data) or other_id(model, message, data)
    if reason == BAD_CHECKSUM:
        return mended or checksum_hint(model, message, data)
    return _other_order(model, message, example) or mended


def _other_length(model: Model, message: MessageLayout, data: bytes) -> str:
    """Hint at the length that so many bytes have, where all else is right with it."""
    frame = message.frame
    part, length = frame.length_part, len(data) - frame.uncounted
    if part is None or length not in message.lengths or part.read_in(data) == length:
        return ""
    mended = data[: part.at] + part.write(length) + data[part.at + part.size :]
    try:
        found = decode(model, message.direction, mended)
    except NotAFrame:
        return ""
    if found.layout is not message:
        return ""
    wrong = f"{part.name} is {part.read_in(data)}, and {len(data)} bytes have {length}"
    return f"{wrong}: with {to_hex(part.write(length))} there, it is one"


def _other(message: MessageLayout, found: MessageLayout) -> str:
    """Say which other message an example is a frame of, and what tells so."""
    what = f"this is a frame of {found.name}"
    if message.frame is found.frame:
        for part in message.frame.ids:
            ours, theirs = message.id_of(part), found.id_of(part)
            if ours != theirs and part not in message.frame.unsent:
                return f"{what}: byte {part.at} is {theirs}, not {ours}"
    return what


def _other_order(model: Model, message: MessageLayout, example: Example) -> str:
    """Hint at the byte order, where the other one would give the values of the example."""
    try:
        frame = encode(message, example.values)
    except Unencodable:
        return ""
    swapped = b"".join(
        placed.of(frame)[::-1] if isinstance(placed.slot, Number) else placed.of(frame)
        for placed in message.lay_out(message.count_of(frame))
    )
    if swapped != example.hex:
        return ""
    order = "big" if model.spec.byte_order == "little" else "little"
    return f"bytes swapped? with `byte_order: {order}`, it has these values"


def _differences(path: KeyPath, frame: Any, said: Any, message: MessageLayout) -> Iterator[Problem]:
    if isinstance(frame, dict) and isinstance(said, dict):
        for key in [key for key in frame if key not in said]:
            yield Problem(path, f"the frame has `{key}`, and the values leave it out")
        for key, value in said.items():
            if key in frame:
                yield from _differences((*path, key), frame[key], value, message)
            else:
                what = f"the frame has no `{key}`"
                yield Problem((*path, key), what, _left_out(message, key), on_key=True)
    elif isinstance(frame, list) and isinstance(said, list):
        if len(frame) != len(said):
            yield Problem(path, f"{len(said)} are listed, and the frame has {len(frame)}")
        for index, (value, other) in enumerate(zip(frame, said, strict=False)):
            yield from _differences((*path, index), value, other, message)
    elif frame != said or type(frame) is not type(said):
        hint = "bytes swapped?" if _swapped(path, frame, said, message) else ""
        yield Problem(path, f"the frame has {_shown(frame)}, not {_shown(said)}", hint)


def _left_out(message: MessageLayout, key: str) -> str:
    """Say why a value is not listed."""
    for slot in message.slots:
        if slot.name == key and isinstance(slot, Number) and slot.counts:
            return "leave it out: it follows from the list"
        if slot.name == key and isinstance(slot, Constant):
            return "leave it out: it never changes"
        if slot.name == key:
            return "leave it out: it follows from the rest of the frame"
    return "leave it out"


def _swapped(path: KeyPath, frame: Any, said: Any, message: MessageLayout) -> bool:
    """Tell whether the frame has the bytes of the number in the other order."""
    _, _, _, _, _, *steps = path
    name = ".".join(step for step in steps if isinstance(step, str))
    number = message.numbers_by_path.get(name)
    if number is None or type(said) is not int or type(frame) is not int:
        return False
    fits = number.number_type.low <= said <= number.number_type.high
    return fits and number.read(number.write(said)[::-1]) == frame


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
    why="Examples are the evidence for everything else: if they do not decode to their values, "
    "the layout is wrong, or they are.",
    bad="{hex: AA 55 02 01 64, values: {percent: 50}}",
    good="{hex: AA 55 02 01 32, values: {percent: 50}}",
    look=_look,
)
