"""The answers that a host got from the independent board, and whether each is allowed.

A call is right if its value answers a question that the board received after the call began. Any
other must be excused: by a fault that happened during it or during the call before. So the second
next call after a fault is right. A stale value is excused only if its reply was complete no earlier
than question and reply can have fitted on the wire, if the right one had not come as well since the
question was sent last, and never twice in a row for one fault.

A call takes as many reply times as it asked, and those for which the replies to the calls before it
may be late: one, or two behind a call that asked again and was answered at once. It asks three
times at most.

A reply that answers nothing half a second after all was answered is a report, as the same message
might come by itself; and so is then each that answers nothing.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

from busservo import AsyncController, Controller, IncompleteReplyError, NoReplyError

from tests.contract.independent.board import BITS_PER_BYTE, NUMBERS, Board
from tests.contract.independent.firmware import (
    QUESTIONS,
    battery_question,
    battery_reply,
    positions_question,
    positions_reply,
)
from tests.contract.independent.ports import VirtualPort
from tests.lines.both_clients import Awaited, done_at_once
from tests.lines.timed_line import client_on

# The battery, or these servos.
Requested = Sequence[int] | None

BAUD = 9600
REPLY_TIMEOUT = 0.25
SIX = (1, 2, 3, 4, 5, 6)
# So many healthy reads show that a line keeps its rate.
HEALTHY = 8
# A line may run this much faster than it should, and no host can know.
FAST = 0.95
# A question is asked so often at most, where no retries are wanted.
ATTEMPTS = 3
# Half a frame that is there as a question would end has so long to go on.
GAP = 0.05
# What answers nothing, and comes so long after the last question of its kind, is a report.
BY_ITSELF = 0.5
# Times that are calculated in two ways differ by less.
MOMENT = 1e-6


class Call(NamedTuple):
    """One read: how many questions the board received `before`, and the number that came back."""

    began: float
    ended: float
    before: int
    number: int | None
    requested: Requested


class Conversation:
    """The calls of one thread or task, in order."""

    def __init__(self, board: Board, now: Callable[[], float]) -> None:
        self.board = board
        self.calls: list[Call] = []
        self.now = now

    def ask(self, controller: Controller, requested: Requested) -> None:
        """Read once. A declared error is recorded, any other is raised."""
        done_at_once(self.ask_async(Awaited(controller), requested))

    async def ask_async(self, controller: AsyncController | Awaited, requested: Requested) -> None:
        """Read once, for asyncio."""
        began, before = self.now(), self.board.questions
        number: int | None = None
        try:
            if requested is None:
                number = await controller.read_battery_voltage()
            else:
                number = only(await controller.read_servo_positions(requested), requested)
        except (NoReplyError, IncompleteReplyError):
            pass
        self.calls.append(Call(began, self.now(), before, number, requested))

    @property
    def stale(self) -> list[Call]:
        """The calls that got the answer to an earlier question."""
        return [each for each in self.calls if each.number and not self._fresh(each)]

    @property
    def failed(self) -> list[Call]:
        """The calls that ended in a declared error."""
        return [each for each in self.calls if each.number is None]

    def check(self, baud: float = BAUD, reply_timeout: float = REPLY_TIMEOUT) -> None:
        """Raise AssertionError if a call took too long, or is wrong without an excuse."""
        since, before_was_stale = float("-inf"), False
        reply_time = reply_timeout + wire_time(SIX, baud)
        asked_again_at = float("-inf")
        for place, call in enumerate(self.calls):
            described = f"call {place} of {len(self.calls)}: {call}"
            asked = self._last(place) - call.before
            waits = 2 if call.began < asked_again_at + 2 * reply_time else 1
            bound = (waits + min(asked, ATTEMPTS)) * reply_time + GAP
            assert call.ended - call.began <= bound, f"it took too long, {bound}: {described}"
            if asked > 1:
                asked_again_at = call.ended
            stale = call.number is not None and not self._fresh(call)
            if call.number is None or stale:
                assert self.board.troubled(since, call.ended), f"nothing excuses it: {described}"
            if stale:
                another = self.board.faulted(since, call.ended)
                assert another or not before_was_stale, f"two in a row are stale: {described}"
                possible_at = call.began + FAST * wire_time(call.requested, baud)
                arrived = self._arrived(call)
                possible = any(at >= possible_at for at in arrived)
                assert possible, f"impossible: {described}, {arrived}"
                assert not self._answered(place, baud), f"its own had come as well: {described}"
            since, before_was_stale = call.began, stale

    def _fresh(self, call: Call) -> bool:
        number = self.board.questions - (self.board.questions - (call.number or 0)) % NUMBERS
        return call.before < number

    def _last(self, place: int) -> int:
        """Return the number of the last question that the board received during a call."""
        following = self.calls[place + 1 : place + 2]
        return following[0].before if following else self.board.questions

    def _answered(self, place: int, baud: float) -> bool:
        """Return whether an answer to a call came before it ended, since it last asked.

        What came at the moment at which it asked is why it asked again.
        """
        call, last = self.calls[place], self._last(place)
        asked_at = self.board.asked_at(last) - seconds(question_of(call.requested), baud)
        return any(
            asked_at + MOMENT < at < call.ended
            for number in range(call.before + 1, last + 1)
            for at in self.board.arrivals(reply_to(call.requested, number))
        )

    def _arrived(self, call: Call) -> list[float]:
        """Return when replies with this number were complete, until the call ended."""
        reply = reply_to(call.requested, call.number or 0)
        return [at for at in self.board.arrivals(reply) if at <= call.ended]


@contextmanager
def talking(to: Any, **given: Any) -> Iterator[tuple[Conversation, Controller]]:
    """Yield the calls at a board in virtual time, or its port, and a client on the time of it."""
    port: Any = VirtualPort(to) if isinstance(to, Board) else to
    talk = Conversation(port.board, port.clock)
    with client_on(port, Controller, **{"reply_timeout": REPLY_TIMEOUT, **given}) as controller:
        yield talk, controller


def without_replies(talks: Sequence[Conversation], received: Sequence[bytes]) -> list[bytes]:
    """Return the reports that are no replies.

    Raises AssertionError if another has not come, is the value of a call, or was asked for.
    """
    calls = [call for talk in talks for call in talk.calls]
    numbered = ((call.requested, call.number) for call in calls if call.number is not None)
    taken = Counter([reply_to(*each) for each in numbered])
    kept: list[bytes] = []
    seen: set[int] = set()
    for frame in received:
        command = frame[3]
        if command not in QUESTIONS:
            kept.append(frame)
            continue
        taken[frame] += 1
        arrived = talks[0].board.arrivals(frame)
        assert taken[frame] <= len(arrived), f"it came {arrived}, for something else: {frame!r}"
        asked = (call for call in calls if question_of(call.requested)[3] == command)
        times = [call.began for call in asked if call.began <= arrived[-1]]
        late = command in seen or max(times) + BY_ITSELF < arrived[-1]
        assert late, f"it was asked for: {frame!r}"
        seen.add(command)
    return kept


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
    return seconds(question_of(requested) + reply_to(requested, 0), baud)


def seconds(data: bytes, baud: float) -> float:
    """Return how long bytes take on the wire."""
    return len(data) * BITS_PER_BYTE / baud


def repeated(talks: Sequence[Conversation]) -> int:
    """Return how many values came more than once, among all conversations."""
    numbers = [call.number for talk in talks for call in talk.calls if call.number is not None]
    return len(numbers) - len(set(numbers))
