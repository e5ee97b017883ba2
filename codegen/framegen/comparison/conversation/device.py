"""The device of an edition: what it sends back for the bytes that reach it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framegen.comparison.conversation.line import arrival, column
from framegen.comparison.edges import values_to_try
from framegen.model.codec import Unencodable, encode
from framegen.model.slots import Items, Number

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.comparison.conversation.line import Received
    from framegen.comparison.pair import Pair
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# How a device may answer a request.
Kind: TypeAlias = Literal["reply", "refusal", "failure"]
# So many answers of a kind are tried at most.
_MOST = 60


@dataclass(frozen=True, slots=True)
class Answer:
    """What a device sends back: a message with its values, as bytes; or nothing, and why."""

    data: bytes = b""
    message: str = ""
    values: dict[str, Any] | None = None
    why: str = ""


@dataclass(frozen=True, eq=False)
class Device:
    """A device that does what an edition promises, and reads what that edition knows."""

    model: Model

    @property
    def exchanges(self) -> dict[str, Exchange]:
        """The exchanges by the name of their request."""
        return self.model.exchanges_by_request

    def reads(self, data: bytes) -> tuple[list[Received], str]:
        """Return the requests that the device reads in bytes, and why the rest is none."""
        if data not in self._read:
            came = arrival(self.model, self.model.roles.sent, data)
            self._read[data] = came.messages, came.refusal
        return self._read[data]

    @cached_property
    def _read(self) -> dict[bytes, tuple[list[Received], str]]:
        """What was read so far: the same request is answered in many ways."""
        return {}

    def kinds(self, request: Received) -> Iterator[Kind]:
        """Yield how the device may answer a request."""
        exchange = self.exchanges[request.message.name]
        yield "reply"
        if exchange.reply is not None and not _silence(exchange, request.values):
            if exchange.refusal is not None:
                yield "refusal"
            if exchange.failure is not None:
                yield "failure"

    def answer(self, request: Received, kind: Kind, given: Mapping[str, Any] | None) -> Answer:
        """Return the answer to a request; `given` are the values of its message, before echoes."""
        exchange = self.exchanges[request.message.name]
        answer = exchange.refusal if kind == "refusal" else exchange.reply
        silence = _silence(exchange, request.values)
        if answer is None or given is None:
            return Answer(why=f"{request.message.name} has no reply")
        if silence:
            return Answer(why=f"nobody answers at {silence}")
        values = self._echoed(exchange, request, answer, given)
        try:
            return Answer(encode(answer, values), answer.name, values)
        except (Unencodable, OverflowError) as error:
            return Answer(why=f"{answer.name} cannot repeat it ({error})")

    def _echoed(
        self,
        exchange: Exchange,
        request: Received,
        answer: MessageLayout,
        given: Mapping[str, Any],
    ) -> dict[str, Any]:
        """Return the values of an answer with all that it repeats of the request."""
        values = dict(given)
        sender = answer.frame.address
        if sender is not None and exchange.address is not None:
            values[sender.name] = request.values[exchange.address.name]
        for requested, reported in exchange.echoed if answer is exchange.reply else ():
            name, _, inner = reported.partition(".")
            said = column(request.values, requested)
            if inner:
                values[name] = _repeated(answer, name, inner, values[name], said)
            elif said:
                values[name] = said if isinstance(values[name], list) else said[0]
        return exchange.with_count(request.values, values) if answer is exchange.reply else values


def answers_to_try(pair: Pair, model: Model, exchange: Exchange, kind: Kind) -> list[Any]:
    """Return values for an answer, at the edges of both editions; None alone where there is none.

    What says that something has failed does so in a failure, and in nothing else.
    """
    answer = exchange.refusal if kind == "refusal" else exchange.reply
    if answer is None:
        return [None]
    is_old = model is pair.old.model
    pairing = pair.messages if is_old else pair.messages.flipped
    name = pairing.to_new.get(answer.name)
    theirs = (pair.new if is_old else pair.old).model
    other = None if name is None else theirs.messages[name]
    names: dict[str, str] = {}
    if other is not None:
        fields = pair.fields(answer, other) if is_old else pair.fields(other, answer).flipped
        names = dict(fields.to_new)
    found: list[Any] = []
    for values in islice(values_to_try(answer, other, names, pairs=False), 4 * _MOST):
        said = values if kind == "refusal" else _saying(exchange, values, failed=kind == "failure")
        if said is not None and said not in found:
            found.append(said)
    return found[:_MOST] or [None]


def _saying(exchange: Exchange, values: dict[str, Any], *, failed: bool) -> dict[str, Any] | None:
    """Return the values of a reply that says whether something failed; None if they cannot."""
    failure = exchange.failure
    if failure is None:
        return values
    if failed:
        return values if exchange.has_failed(values) else None
    return {**values, failure.name: exchange.good} if failure.holds(exchange.good) else values


def _repeated(
    answer: MessageLayout, name: str, inner: str, given: list[Any], said: list[Any]
) -> list[dict[str, Any]]:
    """Return a list of elements that repeat numbers, as many of them as it has room for."""
    slot = next(each for each in answer.fields if isinstance(each, Items) and each.name == name)
    usual = {each.name: each.low if isinstance(each, Number) else "" for each in slot.fields}
    elements = [*given, *[given[0] if given else usual] * len(said)]
    return [{**old, inner: each} for old, each in zip(elements, said[: slot.high], strict=False)]


def _silence(exchange: Exchange, values: Mapping[str, Any]) -> str:
    """Return the name of the address of a request, if nobody answers there."""
    if exchange.address is None:
        return ""
    here = values[exchange.address.name]
    return next((name for name, value in exchange.silent.items() if value == here), "")
