"""What authors write down without any effect but on documents."""

from collections.abc import Callable
from functools import partial
from typing import Any

from tests.mutations.desk import Desk

_THINGS: dict[str, Callable[[Desk], Any]] = {
    "field": lambda desk: desk.spot(lambda _: True).field,
    "value": lambda desk: desk.one_of(desk.number(lambda each: each.get("values")).field["values"]),
    "message": lambda desk: desk.one_of(desk.messages),
    "end": lambda desk: desk.one_of(desk.spec["endpoints"]),
    "part": lambda desk: desk.one_of(desk.pick(desk.kinds.values())),
    "protocol": lambda desk: desk.spec["protocol"],
}


def _said(thing: str, key: str, text: str, desk: Desk) -> None:
    _THINGS[thing](desk)[key] = text


def _noted(thing: str, desk: Desk) -> None:
    cite = next(iter(desk.messages.values()))["cite"]
    _THINGS[thing](desk).setdefault("notes", []).append({"text": "It was seen.", "cite": cite})


_OTHERWISE = "Said in other words."
WORD_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    "words: a field": partial(_said, "field", "about", _OTHERWISE),
    "words: a named value": partial(_said, "value", "about", _OTHERWISE),
    "words: summary": partial(_said, "message", "summary", "Say it in other words."),
    "words: description": partial(_said, "message", "description", "There is more to know."),
    "words: a note": partial(_noted, "field"),
    "words: a note on a message": partial(_noted, "message"),
    "words: a note on a part": partial(_noted, "part"),
    "words: a note on the protocol": partial(_noted, "protocol"),
    "words: a note on an end": partial(_noted, "end"),
    "words: an end": partial(_said, "end", "about", _OTHERWISE),
    "words: a part": partial(_said, "part", "about", _OTHERWISE),
    "words: the title": partial(_said, "protocol", "title", "Another title"),
    "words: the protocol": partial(_said, "protocol", "summary", _OTHERWISE),
}
