"""The answers that a host got from the independent board, and whether each is allowed.

A call is right if its value answers a question that the board received after the call began. Any
other must be excused: by a fault that happened during it or during the call before. So the second
next call after a fault is right. A stale value is excused only if its reply was complete no earlier
than question and reply can have fitted on the wire, if the right one had not come as well, and
never twice in a row for one fault.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

from busservo import IncompleteReplyError, NoReplyError

from tests.contract.independent.board import BITS_PER_BYTE, NUMBERS
from tests.contract.independent.firmware import (
    battery_question,
    battery_reply,
    positions_question,
    positions_reply,
)
from tests.lines.both_clients import Awaited, done_at_once

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from busservo import AsyncController, Controller

    # The battery, or these servos.
    Requested = Sequence[int] | None

SIX = (1, 2, 3, 4, 5, 6)
# A line may run this much faster than it should, and no host can know.
FAST = 0.95


class NumberingBoard(Protocol):
    """A board that answers each question with the number of it."""

    questions: int

    def arrivals(self, data: bytes) -> list[float]:
        """Return when these bytes reached the host."""
        ...

    def troubled(self, since: float, until: float) -> bool:
        """Return whether a wrong value is excused at that time."""
        ...

    def faulted(self, since: float, until: float) -> bool:
        """Return whether a fault began then."""
        ...


class Call(NamedTuple):
    """One read: how many questions the board received `before`, and the number that came back."""

    began: float
    ended: float
    before: int
    number: int | None
    requested: Requested


class Conversation:
    """The calls of one thread or task, in order."""

    def __init__(self, board: NumberingBoard, now: Callable[[], float]) -> None:
        self.board = board
        self.calls: list[Call] = []
        self._now = now

    def ask(self, controller: Controller, requested: Requested) -> None:
        """Read once. A declared error is recorded, any other is raised."""
        done_at_once(self.ask_async(Awaited(controller), requested))

    async def ask_async(self, controller: AsyncController | Awaited, requested: Requested) -> None:
        """Read once, for asyncio."""
        began, before = self._now(), self.board.questions
        number: int | None = None
        try:
            if requested is None:
                number = await controller.read_battery_voltage()
            else:
                number = only(await controller.read_servo_positions(requested), requested)
        except (NoReplyError, IncompleteReplyError):
            pass
        self.calls.append(Call(began, self._now(), before, number, requested))

    @property
    def stale(self) -> list[Call]:
        """The calls that got the answer to an earlier question."""
        return [each for each in self.calls if each.number and not self._fresh(each)]

    @property
    def failed(self) -> list[Call]:
        """The calls that ended in a declared error."""
        return [each for each in self.calls if each.number is None]

    def check(self, baud: float, bound: float) -> None:
        """Raise AssertionError if a call took too long, or is wrong without an excuse."""
        since, before_was_stale = float("-inf"), False
        for place, call in enumerate(self.calls):
            described = f"call {place} of {len(self.calls)}: {call}"
            assert call.ended - call.began <= bound, f"it took too long: {described}"
            stale = call.number is not None and not self._fresh(call)
            if call.number is None or stale:
                assert self.board.troubled(since, call.ended), f"nothing excuses it: {described}"
            if stale:
                another = self.board.faulted(since, call.ended)
                assert another or not before_was_stale, f"two in a row are stale: {described}"
                possible_at = call.began + FAST * wire_time(call.requested, baud)
                arrived = self._arrived(call)
                assert any(at >= possible_at for at in arrived), (
                    f"impossible: {described}, {arrived}"
                )
                assert not self._answered(place), f"the right one had come as well: {described}"
            since, before_was_stale = call.began, stale

    def _fresh(self, call: Call) -> bool:
        number = self.board.questions - (self.board.questions - (call.number or 0)) % NUMBERS
        return call.before < number

    def _answered(self, place: int) -> bool:
        """Return whether an answer to a call had come before it ended."""
        call, following = self.calls[place], self.calls[place + 1 : place + 2]
        last = following[0].before if following else self.board.questions
        return any(
            at < call.ended
            for number in range(call.before + 1, last + 1)
            for at in self.board.arrivals(reply_to(call.requested, number))
        )

    def _arrived(self, call: Call) -> list[float]:
        """Return when replies with this number were complete, until the call ended."""
        reply = reply_to(call.requested, call.number or 0)
        return [at for at in self.board.arrivals(reply) if at <= call.ended]


def only(positions: Sequence[tuple[int, int]], requested: Sequence[int]) -> int:
    """Return the one number that all servos of a reply have."""
    assert [servo_id for servo_id, _ in positions] == list(requested)
    numbers = {position for _, position in positions}
    assert len(numbers) == 1, f"of one reply, all positions are the same: {positions}"
    return numbers.pop()


def question_of(requested: Requested) -> bytes:
    """Return the frame of the question."""
    return battery_question() if requested is None else positions_question(list(requested))


def reply_to(requested: Requested, number: int) -> bytes:
    """Return the frame of its reply."""
    if requested is None:
        return battery_reply(number)
    return positions_reply([(servo_id, number) for servo_id in requested])


def wire_time(requested: Requested, baud: float) -> float:
    """Return how long question and reply take on the wire, at the least."""
    return (len(question_of(requested)) + len(reply_to(requested, 0))) * BITS_PER_BYTE / baud


def repeated(talks: Sequence[Conversation]) -> int:
    """Return how many values came more than once, among all conversations."""
    numbers = [call.number for talk in talks for call in talk.calls if call.number is not None]
    return len(numbers) - len(set(numbers))
