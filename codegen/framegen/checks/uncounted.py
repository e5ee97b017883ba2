"""Remark: a request may say how many items its reply holds, and nothing compares the two."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.asks_for import numbers_given
from framegen.checks.rule import ModelRule, Problem
from framegen.language.values import Range

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model


# What a number of items is called.
_WORDS = {"amount", "bytes", "count", "length", "n", "num", "number", "quantity", "size"}


def _look(model: Model) -> Iterator[Problem]:
    for exchange in model.exchanges:
        counts = _possible(exchange)
        if not counts or exchange.reply is None or exchange.reply.items is None:
            continue
        reply, items = exchange.reply.name, exchange.reply.items.name
        which = " or ".join(f"`{each}`" for each in counts)
        yield Problem(
            ("messages", exchange.request.name, "reply"),
            f"nothing compares the length of `{items}` with what {exchange.request.name} asks for, "
            f"so a client takes a {reply} of any",
            f"if {which} says how many there are, write `asks_for: {counts[0]}`",
        )


def _possible(exchange: Exchange) -> list[str]:
    """Return the numbers of a request that may say how many items its reply holds.

    Where some are called so, these; else those for each of which the reply has room.
    """
    items = None if exchange.reply is None else exchange.reply.items
    if items is None or items.text is not None or exchange.asks_for:
        return []
    if any(reported.partition(".")[0] == items.name for _, reported in exchange.echoed):
        return []
    room, repeated = Range(items.low, items.high), dict(exchange.echoed)
    numbers = [each for each in numbers_given(exchange) if each.name not in repeated]
    fitting = [each for each in numbers if room.holds(Range(each.low, each.high))]
    # A count that was bounded otherwise counts something else, such as bits of bytes.
    called = [each for each in numbers if each in fitting or each.field.range is None]
    named = [each.name for each in called if _WORDS.intersection(each.name.split("_"))]
    return named or [each.name for each in fitting]


RULE = ModelRule(
    id="uncounted",
    title="A reply holds as many items as were asked for",
    why="A late reply to an earlier request, which asked for more or for fewer, looks like the "
    "answer. Whether a number is a count, only the author knows, so this is a remark.",
    bad="LevelsRead: {reply: Levels, fields: {lamp_count: {type: u8, range: 1..20}}}",
    good="LevelsRead: {reply: Levels, asks_for: lamp_count}",
    look=_look,
)
