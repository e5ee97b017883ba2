"""The client of an edition: what it asks, what it awaits, and what it takes for an answer."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framegen.comparison.conversation.line import Arrival, arrival, column

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.comparison.conversation.line import Received
    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

# How a request ends for the program: with the reply, with one that lacks something, with an error
# that tells of a refusal or a failure, with a timeout; or it is a command, which is sent and no
# more; or a question that the client does not put, since nobody answers there.
Ending: TypeAlias = Literal["reply", "partial", "refusal", "failure", "timeout", "sent", "unasked"]
# What becomes of what answers nothing: it is a report, or dropped, or noise.
Rest: TypeAlias = Literal["report", "dropped", "noise"]


@dataclass(frozen=True, slots=True)
class Experience:
    """What a program notices of a request: how it ends, and what else has come.

    `came` are the messages that the client has read, whatever became of them.
    """

    ending: Ending
    rest: frozenset[Rest]
    came: tuple[str, ...]
    refusal: str = ""


@dataclass(frozen=True, eq=False)
class Client:
    """The client that is generated for an edition."""

    model: Model

    @property
    def exchanges(self) -> dict[str, Exchange]:
        """The exchanges by the name of their request."""
        return self.model.exchanges_by_request

    @cached_property
    def answers(self) -> dict[str, list[str]]:
        """The messages that answer something, each with the requests that it may answer."""
        found: dict[str, list[str]] = {}
        for each in self.model.exchanges:
            for answer in each.answers:
                found.setdefault(answer.name, []).append(each.request.name)
        return found

    @cached_property
    def reports(self) -> frozenset[str]:
        """The messages that may follow something."""
        return frozenset(name for each in self.model.exchanges for name in each.reports)

    def is_silent(self, exchange: Exchange, values: Mapping[str, Any]) -> bool:
        """Tell whether nobody is said to answer at the address of a request."""
        address = exchange.address
        return address is not None and values[address.name] in exchange.silent.values()

    def fits(self, exchange: Exchange, values: Mapping[str, Any]) -> bool:
        """Tell whether a reply has room for what is asked: more is asked in parts."""
        requested = exchange.request.items
        return (
            not exchange.most or requested is None or len(values[requested.name]) <= exchange.most
        )

    def experience(self, exchange: Exchange, values: dict[str, Any], data: bytes) -> Experience:
        """Return how a request ends for which these bytes come back."""
        came = arrival(self.model, self.model.roles.received, data)
        silent = self.is_silent(exchange, values)
        # Who answers all at once is gathered, and answers nobody else.
        asked = exchange.reply is not None and not silent
        taken: Received | None = None
        rest: set[Rest] = {"noise"} if came.noise else set()
        for message in came.messages:
            if asked and self._is_answer(exchange, values, message):
                # Of several replies that come at once, the last is the answer.
                rest |= {"dropped"} if taken is not None else set()
                taken = message
            else:
                rest.add(self.becomes(message.message.name))
        ending = self._ending(exchange, values, taken, silent)
        names = tuple(each.message.name for each in came.messages)
        return Experience(ending, frozenset(rest), names, _refusal(came))

    def becomes(self, name: str) -> Rest:
        """Return what becomes of a message that answers nothing: an answer is dropped."""
        return "dropped" if name in self.answers and name not in self.reports else "report"

    def _ending(
        self, exchange: Exchange, values: dict[str, Any], taken: Received | None, silent: bool
    ) -> Ending:
        if exchange.reply is None:
            return "sent"
        if silent:
            return "unasked"
        if taken is None:
            return "timeout"
        return self._taken(exchange, values, taken)

    def _taken(self, exchange: Exchange, values: dict[str, Any], taken: Received) -> Ending:
        """Return how a question ends that is answered."""
        if taken.message is not exchange.reply:
            return "refusal"
        if exchange.has_failed(taken.values):
            return "failure"
        for requested, reported in exchange.echoed:
            there = column(taken.values, reported)
            if any(value not in there for value in column(values, requested)):
                return "partial"
        return "reply"

    def _is_answer(self, exchange: Exchange, values: dict[str, Any], message: Received) -> bool:
        """Tell whether a message answers a request: it holds nothing that was not requested."""
        if message.message not in exchange.answers:
            return False
        address, sender = exchange.address, message.message.frame.address
        if (
            address is not None
            and sender is not None
            and message.values[sender.name] != values[address.name]
        ):
            return False
        if message.message is exchange.refusal:
            return True
        for requested, reported in exchange.echoed:
            left = column(values, requested)
            for value in column(message.values, reported):
                if value not in left:
                    return False
                left.remove(value)
        return not exchange.miscounts(values, message.values)


def _refusal(came: Arrival) -> str:
    return "" if came.messages else came.refusal
