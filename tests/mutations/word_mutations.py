"""What authors write down without any effect but on documents."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.factories import Data
    from tests.mutations.desk import Desk


def _field(desk: Desk) -> Data:
    return desk.spot(lambda _: True).field


def _value(desk: Desk) -> Data:
    values = desk.number(lambda field: field.get("values")).field["values"]
    return desk.one_of(values)


def _message(desk: Desk) -> Data:
    return desk.one_of(desk.messages)


def _end(desk: Desk) -> Data:
    return desk.one_of(desk.spec["endpoints"])


def _part(desk: Desk) -> Data:
    return desk.one_of(desk.pick(desk.kinds.values()))


def _protocol(desk: Desk) -> Data:
    found: Data = desk.spec["protocol"]
    return found


def _said(thing: Callable[[Desk], Data], key: str, text: str, desk: Desk) -> None:
    thing(desk)[key] = text


def _noted(thing: Callable[[Desk], Data], desk: Desk) -> None:
    cite = next(iter(desk.messages.values()))["cite"]
    thing(desk).setdefault("notes", []).append({"text": "It was seen.", "cite": cite})


_OTHERWISE = "Said in other words."
WORD_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    "words: a field": partial(_said, _field, "about", _OTHERWISE),
    "words: a named value": partial(_said, _value, "about", _OTHERWISE),
    "words: summary": partial(_said, _message, "summary", "Say it in other words."),
    "words: description": partial(_said, _message, "description", "There is more to know."),
    "words: a note": partial(_noted, _field),
    "words: a note on a message": partial(_noted, _message),
    "words: a note on a part": partial(_noted, _part),
    "words: a note on the protocol": partial(_noted, _protocol),
    "words: a note on an end": partial(_noted, _end),
    "words: an end": partial(_said, _end, "about", _OTHERWISE),
    "words: a part": partial(_said, _part, "about", _OTHERWISE),
    "words: the title": partial(_said, _protocol, "title", "Another title"),
    "words: the protocol": partial(_said, _protocol, "summary", _OTHERWISE),
}
