"""What authors write down without any effect but on documents."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.factories import Data
    from tests.mutations.desk import Desk


def about_field(desk: Desk) -> None:
    desk.spot(lambda _: True).field["about"] = "Said in other words."


def about_value(desk: Desk) -> None:
    values = desk.number(lambda field: field.get("values")).field["values"]
    values[desk.pick(values)]["about"] = "Said in other words."


def summary(desk: Desk) -> None:
    desk.messages[desk.pick(desk.messages)]["summary"] = "Say it in other words."


def description(desk: Desk) -> None:
    desk.messages[desk.pick(desk.messages)]["description"] = "There is more to know."


def note(desk: Desk) -> None:
    _noted(desk, desk.spot(lambda _: True).field)


def _noted(desk: Desk, thing: Data) -> None:
    cite = next(iter(desk.messages.values()))["cite"]
    thing.setdefault("notes", []).append({"text": "It was seen.", "cite": cite})


def message_note(desk: Desk) -> None:
    _noted(desk, desk.messages[desk.pick(desk.messages)])


def part_note(desk: Desk) -> None:
    parts = desk.pick(desk.kinds.values())
    _noted(desk, parts[desk.pick(parts)])


def protocol_note(desk: Desk) -> None:
    _noted(desk, desk.spec["protocol"])


def endpoint_note(desk: Desk) -> None:
    ends = desk.spec["endpoints"]
    _noted(desk, ends[desk.pick(ends)])


def endpoint_about(desk: Desk) -> None:
    ends = desk.spec["endpoints"]
    ends[desk.pick(ends)]["about"] = "Said in other words."


def part_about(desk: Desk) -> None:
    parts = desk.pick(desk.kinds.values())
    parts[desk.pick(parts)]["about"] = "Said in other words."


def title(desk: Desk) -> None:
    desk.spec["protocol"]["title"] = "Another title"


def protocol_summary(desk: Desk) -> None:
    desk.spec["protocol"]["summary"] = "Said in other words."


WORD_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    "words: a field": about_field,
    "words: a named value": about_value,
    "words: summary": summary,
    "words: description": description,
    "words: a note": note,
    "words: a note on a message": message_note,
    "words: a note on a part": part_note,
    "words: a note on the protocol": protocol_note,
    "words: a note on an end": endpoint_note,
    "words: an end": endpoint_about,
    "words: a part": part_about,
    "words: the title": title,
    "words: the protocol": protocol_summary,
}
