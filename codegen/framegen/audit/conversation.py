"""Requests and replies in a recording: which belong together, which came alone, and how fast."""

from __future__ import annotations

from dataclasses import dataclass, field
from statistics import median
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.audit.sighting import Sighting
    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

# Of the places where something came alone, so many are kept.
_PLACES = 3
# A reply that comes later than this many seconds answers nothing.
_LATE = 60.0
# Nor is it to a request behind which so many others were sent.
_OUTSTANDING = 32


@dataclass
class Conversation:
    """What became of the requests of one kind that expect an answer.

    `seconds` are the times from a request to its reply, where the recording has times. `unanswered`
    and `unsolicited` count requests without a reply, and replies without a request.
    """

    exchange: Exchange
    requests: int = 0
    answered: int = 0
    refused: int = 0
    failed: int = 0
    silent: int = 0
    unanswered: int = 0
    unsolicited: int = 0
    seconds: list[float] = field(default_factory=list)
    unanswered_at: list[str] = field(default_factory=list)
    unsolicited_at: list[str] = field(default_factory=list)

    @property
    def name(self) -> str:
        """The name of the request."""
        return self.exchange.request.name

    @property
    def median(self) -> float | None:
        """The time of the reply in the middle, in seconds."""
        return median(self.seconds) if self.seconds else None


class Conversations:
    """All exchanges of a model that have a reply, matched one sighting after the other."""

    def __init__(self, model: Model) -> None:
        self.by_request = {
            each.request.name: Conversation(each)
            for each in model.exchanges
            if each.reply is not None
        }
        self._answers = {
            answer.name for each in self.by_request.values() for answer in each.exchange.answers
        }
        self._pending: list[tuple[Conversation, Sighting]] = []
        # A request to a silent address that some answer nevertheless, until the next is sent.
        self._gathering: tuple[Conversation, Sighting] | None = None
        self._is_gathered = False
        self._both = {"requests": False, "answers": False}

    @property
    def has_both_ends(self) -> bool:
        """Whether requests and replies were seen: without the other, each says nothing."""
        return all(self._both.values())

    @property
    def answered(self) -> frozenset[str]:
        """The requests that a device has answered."""
        return frozenset(name for name, each in self.by_request.items() if each.answered)

    def add(self, sighting: Sighting) -> None:
        """Take a message that is certain."""
        if sighting.message is None or not sighting.is_certain or sighting.stretch.probe:
            return
        name = sighting.message.name
        if name in self.by_request:
            self._request(self.by_request[name], sighting)
        elif name in self._answers:
            self._answer(name, sighting)

    def end(self) -> None:
        """End a recording: what is pending stays unanswered."""
        for each, request in self._pending:
            _unanswered(each, request)
        self._pending.clear()
        self._gathering = None

    def _request(self, found: Conversation, sighting: Sighting) -> None:
        self._both["requests"] = True
        found.requests += 1
        self._gathering = None
        if _is_silent(found.exchange, sighting.values):
            found.silent += 1
            self._gathering, self._is_gathered = (found, sighting), False
            return
        for pending in [*self._pending]:
            # The same again is a second try; and times that go back are of another recording.
            again = pending[1].data == sighting.data
            if again or not 0 <= _seconds(pending[1], sighting) <= _LATE:
                self._pending.remove(pending)
                _unanswered(*pending)
        self._pending.append((found, sighting))
        if len(self._pending) > _OUTSTANDING:
            _unanswered(*self._pending.pop(0))

    def _answer(self, name: str, sighting: Sighting) -> None:
        self._both["answers"] = True
        for pending in self._pending:
            if _answers(pending, name, sighting):
                self._pending.remove(pending)
                _answered(pending, name, sighting)
                return
        gathering = self._gathering
        if gathering is not None and _answers(gathering, name, sighting):
            # However many answer, it was one request.
            if not self._is_gathered:
                _answered(gathering, name, sighting)
            self._is_gathered = True
            return
        whose = next(
            each
            for each in self.by_request.values()
            if name in [answer.name for answer in each.exchange.answers]
        )
        whose.unsolicited += 1
        if len(whose.unsolicited_at) < _PLACES:
            whose.unsolicited_at.append(sighting.place)


def _answered(pending: tuple[Conversation, Sighting], name: str, answer: Sighting) -> None:
    found, request = pending
    found.answered += 1
    refusal = found.exchange.refusal
    if refusal is not None and refusal.name == name:
        found.refused += 1
    elif found.exchange.has_failed(answer.values):
        found.failed += 1
    if request.stretch.at is not None and answer.stretch.at is not None:
        found.seconds.append(_seconds(request, answer))


def _unanswered(found: Conversation, request: Sighting) -> None:
    found.unanswered += 1
    if len(found.unanswered_at) < _PLACES:
        found.unanswered_at.append(request.place)


def _seconds(before: Sighting, after: Sighting) -> float:
    if before.stretch.at is None or after.stretch.at is None:
        return 0.0
    return after.stretch.at - before.stretch.at


def _is_silent(exchange: Exchange, values: Mapping[str, Any]) -> bool:
    address = exchange.address
    return address is not None and values[address.name] in address.silent


def _answers(pending: tuple[Conversation, Sighting], name: str, answer: Sighting) -> bool:
    """Tell whether a message answers a request: its kind, its device and what it repeats."""
    exchange, request = pending[0].exchange, pending[1]
    if name not in [each.name for each in exchange.answers]:
        return False
    if not 0 <= _seconds(request, answer) <= _LATE:
        return False
    ours, theirs = (
        exchange.address,
        None if answer.message is None else answer.message.frame.address,
    )
    if ours is not None and theirs is not None:
        asked = request.values[ours.name]
        if asked not in ours.named and asked != answer.values[theirs.name]:
            return False
    if exchange.reply is None or name != exchange.reply.name:
        return True
    return not exchange.miscounts(request.values, answer.values) and all(
        _repeats(_at(request.values, said), _at(answer.values, again))
        for said, again in exchange.echoed
    )


def _at(values: Mapping[str, Any], path: str) -> Any:
    name, _, inner = path.partition(".")
    value = values[name]
    return [item[inner] for item in value] if inner else value


def _repeats(said: Any, again: Any) -> bool:
    """Tell whether a reply repeats a value; of a list, it may leave elements out."""
    if isinstance(said, list) and isinstance(again, list):
        return set(again) <= set(said)
    return bool(said == again)
