"""The reader of questions in the line language."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.conformance.language import QUIET, Decode, Encode, Stream
from framegen.model.slots import Number
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.conformance.language import Question
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Items

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
    for missing in [name for name in due if name not in given]:
        raise NotAQuestion(f"{message.name} lacks `{missing}=`")
    for word in [word for word in given if word not in due]:
        raise NotAQuestion(f"{message.name} has no `{word}` to be given")
    return Encode(message, {name: _value(message, due[name], given[name]) for name in due})


def _value(message: MessageLayout, slot: Number | Items, text: str) -> Any:
    try:
        if isinstance(slot, Number):
            return int(text)
        items = [[int(each) for each in item.split(":")] for item in text.split(",") if item]
        if slot.element is None:
            return [only for (only,) in items]
        names = [field.name for field in slot.fields]
        return [dict(zip(names, item, strict=True)) for item in items]
    except ValueError:
        form = "a number"
        if not isinstance(slot, Number):
            one = ":".join(field.name for field in slot.fields)
            form = f"a list, {one},{one}"
        said = f"`{text[:40]}` is no {slot.name} of {message.name}"
        raise NotAQuestion(f"{said}: write {form}") from None
