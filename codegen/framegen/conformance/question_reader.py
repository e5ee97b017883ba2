"""The reader of questions in the line language."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.conformance.language import QUIET, Decode, Encode, Stream, single_value, unescaped
from framegen.model.slots import Items, Number, Packed, Text
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.conformance.language import Question
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field

_VERBS = ("decode", "encode", "stream")


class NotAQuestion(ValueError):  # noqa: N818 - says what the line is
    """A line that is no question: what is wrong with it, and what to write."""


def read_question(model: Model, line: str) -> Question:
    """Read the question in a line. Raises NotAQuestion."""
    verb, *words = line.split() or [""]
    match verb, words:
        case "decode", [way, *pieces]:
            return Decode(_way(model, way), _bytes("".join(pieces)))
        case "encode", [name, *given]:
            return _encode(model, name, given)
        case "stream", [way, largest, *parts]:
            if not largest.isdecimal():
                raise NotAQuestion(f"`{largest}` is no size of a frame: write a number of bytes")
            said = tuple(None if part == QUIET else _bytes(part) for part in parts)
            return Stream(_way(model, way), int(largest), said)
        case (("decode" | "stream"), _):
            size = " LARGEST PARTS..." if verb == "stream" else " HEX"
            raise NotAQuestion(f"too short: write `{verb} WAY{size}`")
        case "encode", _:
            raise NotAQuestion("too short: write `encode NAME FIELDS...`")
    raise NotAQuestion(f"there is no question `{verb}`: {did_you_mean(verb, _VERBS)}")


def _way(model: Model, key: str) -> Direction:
    ways = {way.key: way for way in model.ways}
    if key not in ways:
        raise NotAQuestion(f"there is no way `{key}`: {did_you_mean(key, ways)}")
    return ways[key]


def _bytes(text: str) -> bytes:
    try:
        return bytes.fromhex(text)
    except ValueError:
        raise NotAQuestion(f"`{text[:40]}` is no hex: write two digits a byte") from None


def _encode(model: Model, name: str, words: Sequence[str]) -> Encode:
    if name not in model.messages:
        raise NotAQuestion(f"there is no message `{name}`: {did_you_mean(name, model.messages)}")
    message = model.messages[name]
    given = dict(word.partition("=")[::2] for word in words)
    due = {slot.name: slot for slot in message.arguments}
    absent = {slot.name for slot in message.optional} - {*given}
    for missing in [name for name in due if name not in {*given, *absent}]:
        raise NotAQuestion(f"{message.name} lacks `{missing}=`")
    for word in [word for word in given if word not in due]:
        raise NotAQuestion(f"{message.name} has no `{word}` to be given")
    values = {name: _value(message, due[name], given[name]) for name in due if name in given}
    return Encode(message, {name: values.get(name) for name in due})


def _value(message: MessageLayout, slot: Field, text: str) -> Any:
    try:
        match slot:
            case Items() if slot.text is None:
                return [_item(slot, item) for item in text.split(",") if item]
            case Packed():
                return [int(each) for each in text.split(",") if each]
            case Items():
                return unescaped(text)
            case _:
                return single_value(slot, text)
    except ValueError:
        said = f"`{text[:40]}` is no {slot.name} of {message.name}"
        raise NotAQuestion(f"{said}: write {_form(slot)}") from None


def _item(items: Items, text: str) -> Any:
    if items.element is None:
        return single_value(items.fields[0], text)
    pairs = zip(items.fields, text.split(":"), strict=True)
    return {field.name: single_value(field, word) for field, word in pairs}


def _form(slot: Field) -> str:
    if isinstance(slot, Number):
        return "a number"
    if isinstance(slot, Text) or (isinstance(slot, Items) and slot.text is not None):
        return "text"
    one = ":".join(field.name for field in slot.fields) if isinstance(slot, Items) else slot.name
    return f"a list, {one},{one}"
