"""What authors write down without any effect but on documents."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.comparison.desk import Desk


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
    field = desk.spot(lambda _: True).field
    cite = next(iter(desk.messages.values()))["cite"]
    field.setdefault("notes", []).append({"text": "It was seen.", "cite": cite})


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
    "words: a part": part_about,
    "words: the title": title,
    "words: the protocol": protocol_summary,
}
