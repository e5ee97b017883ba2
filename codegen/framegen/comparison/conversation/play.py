"""Exchanges played between ends of two editions: a request, its answer, and how it ends."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import chain, islice
from typing import TYPE_CHECKING, Any

from framegen.comparison.conversation.client import Client
from framegen.comparison.conversation.device import Answer, Device, answers_to_try
from framegen.comparison.edges import values_to_try
from framegen.comparison.meaning import translated
from framegen.model.codec import Unencodable, encode
from framegen.model.slots import Number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.conversation.client import Ending, Experience
    from framegen.comparison.conversation.device import Kind
    from framegen.comparison.effect import Which
    from framegen.comparison.pair import Pair
    from framegen.model.exchanges import Exchange
    from framegen.model.slots import Items

OTHER: dict[Which, Which] = {"old": "new", "new": "old"}
# So many requests of a message are tried at most; of an exchange that no edition changed, so many.
_MOST = 80
_FEW = 4


@dataclass(frozen=True)
class Play:
    """One request of a client, answered by a device of the other edition.

    `values` and `data` are the request, `read_as` the requests that the device makes of it, and
    `refusal` why it makes none. `kind` is how the device answers, if it can. `before` is the same
    between two ends of the old edition: None where they could not say it.
    """

    client: Which
    exchange: Exchange
    values: dict[str, Any]
    data: bytes
    read_as: tuple[str, ...]
    refusal: str
    kind: Kind
    answers: tuple[Answer, ...]
    seen: Experience
    before: Play | None = None

    @property
    def answered(self) -> bytes:
        """All bytes that come back."""
        return b"".join(each.data for each in self.answers)

    @property
    def ending(self) -> Ending:
        """How it ends."""
        return self.seen.ending


def _in_many(exchange: Exchange, other: Exchange | None) -> Iterator[dict[str, Any]]:
    """Yield values of a request for as much as a reply has room for, in the one edition or other.

    They are all different, so that it shows which of them a reply lacks.
    """
    items = exchange.request.items
    if other is None or items is None or items.text is not None or exchange.most == other.most:
        return
    given = next(values_to_try(exchange.request, None, {}, pairs=False))
    for count in sorted(each for each in (exchange.most, other.most) if each):
        if count in exchange.request.counts:
            yield {**given, items.name: [_nth(items, at) for at in range(count)]}


def _nth(items: Items, at: int) -> Any:
    """Return an element of a list that no other is like, as far as there are others."""
    values = {
        each.name: min(each.low + at, each.high) if isinstance(each, Number) else ""
        for each in items.fields
    }
    return values if items.element is not None else next(iter(values.values()))


@dataclass(frozen=True, eq=False)
class Table:
    """The clients and devices of two editions, at one table."""

    pair: Pair

    @cached_property
    def clients(self) -> dict[Which, Client]:
        """The client of each edition."""
        return {"old": Client(self.pair.old.model), "new": Client(self.pair.new.model)}

    @cached_property
    def devices(self) -> dict[Which, Device]:
        """The device of each edition."""
        return {"old": Device(self.pair.old.model), "new": Device(self.pair.new.model)}

    def other(self, client: Which, exchange: Exchange) -> Exchange | None:
        """Return the same exchange in the edition of the device; None where it has none."""
        pairing = self.pair.messages if client == "old" else self.pair.messages.flipped
        name = pairing.to_new.get(exchange.request.name, "")
        return self.clients[OTHER[client]].exchanges.get(name)

    def is_linked_first(self, exchange: Exchange) -> bool:
        """Tell whether the new edition is the first to say what a request and a message have to do.

        Both were known, the one as a command, the other as a report of which nothing says when it
        comes: then the author may have written down what devices always did, and that is
        documentation.
        """
        if exchange is not self.clients["new"].exchanges.get(exchange.request.name):
            return False
        other, old = self.other("new", exchange), self.clients["old"]
        name = (
            None if exchange.reply is None else self.pair.messages.to_old.get(exchange.reply.name)
        )
        if other is None or other.reply is not None or name is None:
            return False
        awaited = {each.acknowledged for each in old.exchanges.values()}
        return not (name in old.answers or name in old.reports or name in awaited)

    def plays(self, client: Which, exchange: Exchange) -> Iterator[Play]:
        """Yield what becomes of a request: at its edges, then for each answer at the edges of it.

        What is varied in the one keeps a usual value in the other.
        """
        answered = False
        for values, data in self.requests(client, exchange):
            there, _ = self.devices[OTHER[client]].reads(data)
            kinds: dict[Kind, None] = {} if there else {"reply": None}
            for each in there:
                kinds |= dict.fromkeys(self.devices[OTHER[client]].kinds(each))
            for kind in kinds:
                # All answers are tried once, where there are any.
                for at in range(1 if answered else self._most(client, there, kind)):
                    yield self.play(client, exchange, values, data, kind, at)
            silent = self.clients[client].is_silent(exchange, values)
            answered = answered or (bool(there) and not silent)

    def requests(self, client: Which, exchange: Exchange) -> Iterator[tuple[dict[str, Any], bytes]]:
        """Yield the requests that are tried: their values, and their frames."""
        other = self.other(client, exchange)
        request, theirs = exchange.request, None if other is None else other.request
        names: dict[str, str] = {}
        if theirs is not None:
            fields = (
                self.pair.fields(request, theirs)
                if client == "old"
                else self.pair.fields(theirs, request).flipped
            )
            names = dict(fields.to_new)
        most = _FEW if self._alike(exchange, other) else _MOST
        usual = islice(values_to_try(request, theirs, names, pairs=False), most)
        for values in chain(usual, _in_many(exchange, other)):
            # The client numbers what it sends.
            counter = request.frame.counter
            numbered = values if counter is None else {**values, counter.name: 0}
            if self.clients[client].fits(exchange, numbered):
                try:
                    yield numbered, encode(request, numbered)
                except (Unencodable, OverflowError):
                    continue  # the spec contradicts itself

    def _alike(self, exchange: Exchange, other: Exchange | None) -> bool:
        """Tell whether both editions say the same of an exchange, down to its last byte."""
        old, new = self.pair.old.spec, self.pair.new.spec
        if other is None or (old.byte_order, old.envelopes) != (new.byte_order, new.envelopes):
            return False
        ours, theirs = (
            [each.request.message, *(answer.message for answer in each.answers)]
            for each in (exchange, other)
        )
        return ours == theirs

    def _most(self, client: Which, there: Any, kind: Kind) -> int:
        device: Which = OTHER[client]
        return max(
            (len(self._answers(device, each.message.name, kind)) for each in there), default=1
        )

    def _answers(self, device: Which, request: str, kind: Kind) -> list[Any]:
        key = device, request, kind
        if key not in self._tried:
            here = self.devices[device]
            exchange = here.exchanges[request]
            other = self.other(device, exchange)
            tried = answers_to_try(self.pair, here.model, exchange, kind)
            self._tried[key] = tried[:_FEW] if self._alike(exchange, other) else tried
        return self._tried[key]

    @cached_property
    def _tried(self) -> dict[tuple[Which, str, Kind], list[Any]]:
        return {}

    def play(
        self,
        client: Which,
        exchange: Exchange,
        values: dict[str, Any],
        data: bytes,
        kind: Kind,
        at: int = 0,
    ) -> Play:
        """Return what becomes of a request that a device answers in its nth way of a kind."""
        device: Which = OTHER[client]
        here = self.devices[device]
        there, refusal = here.reads(data)
        answers = self._answered(device, data, kind, at)
        back = b"".join(each.data for each in answers)
        seen = self.clients[client].experience(exchange, values, back)
        read_as = tuple(each.message.name for each in there)
        before = self._before(client, exchange, values, kind, at)
        return Play(client, exchange, values, data, read_as, refusal, kind, answers, seen, before)

    def _answered(self, device: Which, data: bytes, kind: Kind, at: int) -> tuple[Answer, ...]:
        """Return what a device sends back for bytes, answering in its nth way."""
        here = self.devices[device]
        answers: list[Answer] = []
        for each in here.reads(data)[0]:
            given = self._answers(device, each.message.name, kind)
            answers.append(here.answer(each, kind, given[min(at, len(given) - 1)]))
        return tuple(answers)

    def before(self, client: Which, exchange: Exchange, values: dict[str, Any]) -> bytes | None:
        """Return how the old edition says a request; None where it cannot say that.

        What it says in parts, since a reply has no room for all, begins with the first of them.
        """
        was, said = exchange, values
        if client == "new":
            other = self.other("new", exchange)
            if other is None:
                return None
            fields = self.pair.fields(other.request, exchange.request).flipped
            old = translated(fields, exchange.request, other.request, values)
            if old is None:
                return None
            was, said = other, old
        if was.split is not None and not self.clients["old"].fits(was, said):
            said = {**said, was.split.name: said[was.split.name][: was.most]}
        try:
            return encode(was.request, said)
        except (Unencodable, OverflowError):
            return None

    def _before(
        self, client: Which, exchange: Exchange, values: dict[str, Any], kind: Kind, at: int
    ) -> Play | None:
        """Return the same between two ends of the old edition, if they can say it."""
        data = self.before(client, exchange, values)
        if data is None:
            return None
        device = self.devices["old"]
        there = device.reads(data)[0]
        sent = next(iter(there), None)
        if sent is None or not any(kind in device.kinds(each) for each in there):
            return None
        # The device of the mixed pair is new where the client is old: it answers in its own ways.
        back = self._answered("old", data, kind, at if client == "new" else 0)
        asker = self.clients["old"]
        was = asker.exchanges[sent.message.name]
        seen = asker.experience(was, sent.values, b"".join(each.data for each in back))
        read_as = tuple(each.message.name for each in there)
        return Play("old", was, sent.values, data, read_as, "", kind, back, seen)
