"""Replies of the size that was asked for, and of others: which of them answer their request."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framewire.frame.pluralize import pluralize

from framegen.cases.valid import frames_of, values_at
from framegen.model.codec import encode

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True)
class Reply:
    """A request, and what may come for it; by their values."""

    exchange: Exchange
    message: MessageLayout
    asked: Mapping[str, Any]
    replied: Mapping[str, Any]

    @property
    def title(self) -> str:
        """How many items it holds, of how many."""
        asked = pluralize(self.exchange.asked(self.asked), "item")
        held = "as many" if self.answers else str(self._held)
        if self.exchange.has_failed(self.replied):
            held = "none, since it failed"
        return f"{self.exchange.request.name} asks for {asked}, and the reply holds {held}"

    @property
    def request(self) -> bytes:
        """The frame that asks."""
        return encode(self.exchange.request, self.asked)

    @property
    def reply(self) -> bytes:
        """The frame that may answer it."""
        return encode(self.message, self.replied)

    @property
    def answers(self) -> bool:
        """Whether it does."""
        return not self.exchange.miscounts(self.asked, self.replied)

    @property
    def _held(self) -> int:
        items = self.exchange.counted
        return 0 if items is None else len(self.replied[items.name])


def replies(model: Model) -> Iterator[Reply]:
    """Yield, for each number of items that is asked for, as many of them, and one fewer and more.

    Where a reply says what has failed, it says so without any, too.
    """
    for exchange in model.exchanges:
        # Which of several elements are repeated says how many, too.
        reply = exchange.reply
        if (
            reply is None
            or not exchange.asks_for
            or any("." in path for _, path in exchange.echoed)
        ):
            continue
        asked_for: set[int] = set()
        for request in frames_of(exchange.request):
            count = exchange.asked(request.values)
            if count not in asked_for:
                asked_for.add(count)
                for values in _values(exchange, reply, request.values, count):
                    yield Reply(exchange, reply, request.values, values)


def _values(
    exchange: Exchange, reply: MessageLayout, asked: Mapping[str, Any], count: int
) -> Iterator[dict[str, Any]]:
    """Yield the values of a reply with so many items, with others, and of one that failed."""
    parts = (reply.frame.address, reply.frame.counter)
    same = {path: asked[name] for name, path in exchange.echoed}
    same |= {each.name: asked[each.name] for each in parts if each and each.name in asked}
    failure = exchange.failure
    if failure is not None:
        same[failure.name] = exchange.good
    for held in (count, count - 1, count + 1):
        if held in reply.counts:
            yield values_at(reply, "low", held) | same
    if failure is not None and 0 in reply.counts:
        bad = failure.low if exchange.good != failure.low else failure.high
        yield values_at(reply, "low", 0) | same | {failure.name: bad}
