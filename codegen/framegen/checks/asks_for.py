"""Rule: a request can say how many items its reply holds if that has a list with such counts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.values import Range
from framegen.model.slots import Items, Number
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model


def counts_asked(exchange: Exchange) -> dict[str, Range]:
    """Return the fields of a request that could say how many items are asked for, with the counts.

    These are whole numbers, and its list.
    """
    items = exchange.request.items
    found: list[Number | Items] = [*numbers_given(exchange)]
    found += [] if items is None or items.text is not None else [items]
    return {slot.name: Range(slot.low, slot.high) for slot in found}


def numbers_given(exchange: Exchange) -> list[Number]:
    """Return the whole numbers that a request is given."""
    numbers = (slot for slot in exchange.request.fields if isinstance(slot, Number))
    return [number for number in numbers if number.given and not number.is_float]


def _look(model: Model) -> Iterator[Problem]:
    sent = {each.request.name: each for each in model.exchanges}
    for name, message in model.spec.messages.items():
        if message.asks_for is None:
            continue
        exchange = sent.get(name)
        found = _misuse(name, message.asks_for, exchange)
        if found is not None:
            yield Problem(("messages", name, "asks_for"), *found)


def _misuse(name: str, field: str, exchange: Exchange | None) -> tuple[str, str] | None:
    if exchange is None or exchange.reply is None:
        what = f"{name} has no reply that could hold what it asks for"
        return what, "declare its `reply`, or leave out `asks_for`"
    items, reply = exchange.reply.items, exchange.reply.name
    if items is None or items.text is not None:
        what = f"{reply} has no list of a size that varies"
        return what, "leave out `asks_for`: there is nothing to count"
    counts = counts_asked(exchange)
    if field not in counts:
        what = f"{name} has no argument `{field}` that could be a count"
        return what, did_you_mean(field, list(counts))
    room = Range(items.low, items.high)
    if not room.holds(counts[field]):
        what = f"`{field}` may ask for {counts[field]}, and `{items.name}` holds {room}"
        return what, f"bound it to what can be answered, such as by `range: {room}`"
    return None


RULE = ModelRule(
    id="asks-for",
    title="What a request asks for is a number of items that its reply has room for",
    why="A client takes only a reply with as many items: where there are none, or never so many, "
    "no reply ever answers.",
    bad="LevelsRead: {reply: Levels, asks_for: lamps, fields: {lamp_count: {type: u8}}}",
    good="LevelsRead: {reply: Levels, asks_for: lamp_count, fields: {lamp_count: {type: u8}}}",
    look=_look,
)
