"""Which of the replies that come is the answer, which is held, late, or unsolicited.

No frame says which request it answers. A reply has the class that answers a pending question, comes
from the device that was asked, where frames say whom they are from, and holds nothing that was not
requested. A message of such a class that is no reply is **unsolicited**: it is counted, dropped,
and never taken for anything else; unless it is a report: the protocol says that it may be one, or
it came by itself, see Unasked.

A reply must be possible. It cannot be complete before the question and itself have had their time
on the wire. A reply that is complete sooner was meant for somebody else, as when the reply before
came twice, or much too late; or the line is no wire of the stated rate, as it must be where that
device was never asked for such a reply before. Otherwise it is **held** for one reply time. If a
second one comes on a line that keeps its rate, that is the answer, and the first is unsolicited. If
none comes, what is known of the line decides: see Pace. And after a reply that is possible, but
sooner than is usual on this line, the next question of its kind waits a moment, so that the right
one, if there is another, is not taken for the reply to that.

After a question has timed out, or was cancelled, or the line was lost, its reply may still come
**late**, and would look like the reply to the next question of the same kind. So the next waits,
unsent, until that reply has come, or until the time that the question was given has passed once
more. That time begins when the question is given up, which may be long after its deadline if the
whole machine has paused, and the reply with it. If it has not come by then, it may come yet, so the
reply to the next is held, too. All that is kept for each device: one that is silent delays no
question to another, once nobody on this line has ever taken so long.

Of two replies to one question that differ, **none is chosen** if either may be its own: neither
came too soon, or both were read at once. A question is **in doubt** then, as it is where the only
reply behind one that was lost is later than is usual on this line. All that has come is dropped,
and Session asks again, or ends with what has come.
"""

from __future__ import annotations

from sys import maxsize

from .late_replies import LateReplies, Origin
from .pace import Pace
from .request import Step
from .unasked import Unasked

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import TypeAlias

    from ..codec.counters import LineCounters
    from ..frame.message import Message
    from .library import Library
    from .request import Request
    from .wire_time import WireTime

    Answer: TypeAlias = tuple[Request, Message]

_NEVER = float("inf")
# How often a question is asked again because nothing tells which reply is its own.
_DOUBTS = 2
# How much longer a device may take than any has taken so far, before it keeps others waiting no
# longer: adapters hand on what they have received only every 16 ms.
_HESITATION = 0.02


class ReplyMatcher:
    """Knows the requests that are pending, and what has come and may come for them and for others.

    Only a device that is one of many, and overdue, lets another be asked meanwhile. `latency` is
    how long a device takes at most until it begins to answer.
    """

    def __init__(
        self,
        library: Library,
        wire_time: WireTime,
        counters: LineCounters,
        latency: float,
        name: str,
        now: float,
    ) -> None:
        self._answers = library.answers
        self._reporting = library.reports
        self._log = library.log
        self._wire_time = wire_time
        self._counters = counters
        self._latency = latency
        self._name = name
        self.pace = Pace()
        self.late = LateReplies()
        self._unasked = Unasked(latency, now)
        # What was held as a reply, and has turned out to have come by itself.
        self._reports: list[Message] = []
        # The questions that have been sent, and are not over, in the order in which they were sent.
        self.pending: list[Request] = []
        # The classes of what has been asked for so far, and of whom; None for all, or the only one.
        self._asked: set[tuple[type[Message], int | None]] = set()

    # ------------------------------------------------------------------ sending

    def may_be_mistaken(self, request: Request, now: float) -> bool:
        """Whether a reply to a question might be confused with one that may yet come."""
        origin = request.answered_by
        if self.pending and (
            self.waits_for_reply(now)
            or any(each.answered_by.meets(origin) for each in self.pending)
        ):
            return True
        # A further attempt accepts the late reply to an earlier one.
        return not request.attempts and self.late.awaited(origin, now)

    def waits_for_reply(self, now: float) -> bool:
        """Whether a device may be about to answer."""
        return any(now < self._overdue_at(each) for each in self.pending)

    def overdue(self, now: float) -> list[float]:
        """Return when those who may be about to answer will be overdue, as far as is known."""
        times = (self._overdue_at(each) for each in self.pending)
        return [at for at in times if now < at < _NEVER]

    def _overdue_at(self, pending: Request) -> float:
        """Return when an answer is overdue; never, where nobody else could be asked."""
        slowest = self.pace.slowest
        if pending.address is None or not pending.written or slowest is None:
            return _NEVER
        answer = self._wire_time.seconds(pending.reply_size)
        return pending.left_at + answer + 2 * slowest + _HESITATION

    def sent(self, request: Request) -> None:
        """Record that a question has been sent."""
        if request.attempts == 1:
            request.after_lost = self.late.take_missing(request.answered_by)
            if request.address is not None:
                request.is_first = not self._was_asked(request)
            if request.shares_wire:
                self._asked.update((kind, request.address) for kind in request.answered_by.kinds)
        until = request.deadline + (request.deadline - request.left_at)
        for kind in request.answered_by.kinds:
            self._unasked.asked(kind, request.address, until)
        self.pending.append(request)

    def _was_asked(self, request: Request) -> bool:
        """Return whether the same has been asked of the same device before, or of all."""
        kinds, addresses = request.answered_by.kinds, (request.address, None)
        return any((kind, address) in self._asked for kind in kinds for address in addresses)

    # ------------------------------------------------------------------ receiving

    def ends_with(
        self, message: Message, longer: Iterable[type[Message] | None], now: float
    ) -> bool:
        """Whether a message answers what is pending, and none of these longer ones may come now."""
        answers = (each.exchange.answers(each.message, message) for each in self.pending)
        return any(answers) and not any(self._may_come(kind, now) for kind in longer)

    def _may_come(self, kind: type[Message] | None, now: float) -> bool:
        """Return whether a message of a class may come now; None is one that nobody knows."""
        if kind is None or kind not in self._answers or kind in self._reporting:
            return True
        asked = any(kind in each.exchange.kinds for each in self.pending)
        return asked or self.late.awaited(Origin((kind,), None), now)

    def take(self, message: Message, now: float) -> bool:
        """Take in a message, unless it is a report; whether it was taken."""
        for pending in self.pending:
            # What had come before the question was sent, or before its echo, cannot answer it.
            early = now < pending.sent_at or pending.echo_due
            if not early and pending.exchange.answers(pending.message, message):
                self._unasked.answered(type(message), pending.address, now)
                self._hold(pending, message, now)
                return True
        if type(message) not in self._answers:
            return False
        origin = self._origin(message)
        by_itself = self._unasked.came(type(message), origin.address, now)
        if type(message) in self._reporting:
            self.late.came(origin)
            return False
        if by_itself and not self.late.awaited(origin, now):
            self.pace.surplus(origin.address)
            return False
        self._drop_unsolicited(message)
        return True

    def take_reports(self) -> list[Message]:
        """Take out what was held as a reply, and has turned out to have come by itself."""
        reports, self._reports = self._reports, []
        return reports

    def _hold(self, pending: Request, message: Message, now: float) -> None:
        """Keep a reply to a question: the latest, or all where those of all are gathered."""
        if pending.within is not None:
            self._counters.replies += 1
            pending.gathered.append(message)
            return
        if pending.held is not None:
            self._displace(pending, *pending.held, message)
        pending.held = message, now
        pending.take(Step.HOLD)

    def _displace(self, pending: Request, earlier: Message, at: float, later: Message) -> None:
        """Drop the reply that is held: it is no answer, the same once more, or as good as this.

        It is none if it came too soon, on a line that keeps to its rate; or if it is an echo.
        """
        kind = type(earlier)
        if not pending.after_lost and (kind in self._reporting or self._unasked.comes(kind)):
            # Either is of now, and neither is lost.
            self._reports.append(earlier)
            return
        too_soon = self.pace.keeps_time and self._delay(pending, earlier, at) < 0
        foreign = too_soon or earlier.encode() == pending.message.encode()
        if not foreign and earlier != later:
            pending.rivals.append(earlier)
        self._drop_unsolicited(earlier)
        pending.after_lost = False

    def weigh(self) -> list[Answer]:
        """Give the replies that are held, if the wire can have carried them: they are answers."""
        answers: list[Answer] = []
        for pending in [*self.pending]:
            if pending.held is not None and not pending.rivals:
                answers += self._weighed(pending, *pending.held)
        return answers

    def in_doubt(self) -> list[Request]:
        """Return the questions of which nothing tells whether what has come is the answer."""
        return [pending for pending in self.pending if pending.rivals]

    def may_be_repeated(self, pending: Request) -> bool:
        """Return whether a question may be asked again for being in doubt."""
        return pending.exchange.is_query and pending.doubts < _DOUBTS

    def set_aside(self, pending: Request) -> tuple[Message, ...]:
        """Drop all replies to a question in doubt, and return them: one may be its own."""
        rivals, pending.rivals = pending.rivals, []
        if pending.held is not None:
            rivals.append(pending.held[0])
            self._let_go(pending, "another came that differs, and may be the answer as well")
        pending.doubts += 1
        # All of them have come, and only one can have been meant for somebody else's question.
        pending.owed = max(0, pending.owed - (len(rivals) - 1))
        pending.is_first = False
        return tuple(rivals)

    def _weighed(self, pending: Request, reply: Message, at: float) -> list[Answer]:
        possible = self._delay(pending, reply, at) >= 0
        if (possible or self.pace.is_fast(pending.address)) and not pending.after_lost:
            if possible:
                self._learn(pending, reply, at)
            return [self._answer(pending, reply, at)]
        if not possible and not pending.doubted:
            pending.doubted = True
            self._counters.impossible += 1
            self._log().debug("%s: %r came sooner than the wire allows", self._name, reply)
        if pending.is_first and reply.encode() != pending.message.encode():
            # Nobody has asked this device for it before, and it is no echo.
            self.pace.answered_too_soon(pending.address)
            return [self._answer(pending, reply, at)]
        return []

    def held_until(self, pending: Request) -> float:
        """Until when another reply may take the place of one that is held."""
        return pending.left_at + self._wire_time.seconds(pending.reply_size) + self._latency

    def decide(self, pending: Request, now: float) -> Answer | None:
        """Give the reply that is held where it is to be believed, since no other has come."""
        if pending.held is None:
            return None
        reply, at = pending.held
        paced = self.pace.paced
        if self._delay(pending, reply, at) >= 0:
            if self._may_be_the_lost(pending, reply, at) and self.may_be_repeated(pending):
                pending.rivals.append(reply)
                self._let_go(pending, "it is as late as the one that was lost, and may be that")
                return None
            self._learn(pending, reply, at)
            return self._answer(pending, reply, now)
        self.pace.answered_too_soon(pending.address)
        if not paced or self.pace.is_fast(pending.address):
            return self._answer(pending, reply, now)
        self._let_go(pending, "it came sooner than the wire allows, on a line that keeps its rate")
        return None

    # ------------------------------------------------------------------ giving up

    def retry(self, pending: Request) -> None:
        """Have a pending question wait for a further attempt."""
        pending.take(Step.RETRY)
        self.pending.remove(pending)

    def give_up(self, pending: Request, since: float, held_until: float) -> None:
        """Await no longer the reply to a pending question, which may come all the same."""
        held, pending.held = pending.held, None
        self.pending.remove(pending)
        if held is None:
            self.expect_late(pending, since)
            return
        # The reply that is held may be its own; if not, its own is waited for as long as that is
        # held.
        reply, _ = held
        self._drop(reply, "what it may answer was given up")
        self.late.expect(self._origin(reply), pending.owed, held_until, owed=False)

    def end_gathering(self, pending: Request, since: float) -> None:
        """End a question to all: whoever has not answered yet may do so for as long once more."""
        self.pending.remove(pending)
        until = since + (pending.deadline - pending.left_at)
        self.late.expect(pending.answered_by, maxsize, until, owed=False)

    def lose(self) -> None:
        """Forget what is pending: the line is gone."""
        for pending in self.pending:
            pending.held = None
        self.pending.clear()

    def expect_late(self, request: Request, since: float) -> None:
        """Record that replies may come for all attempts of a request that none has come for."""
        self._expect(request, request.owed, since)

    def restart(self, now: float) -> None:
        """Begin anew on another line, whose pace nobody knows."""
        self.pace = Pace()
        self._unasked.begin(now)
        self._asked.clear()

    def _expect(self, request: Request, count: int, since: float) -> None:
        if count and request.question:
            until = since + (request.deadline - request.left_at)
            self.late.expect(request.answered_by, count, until)

    def _delay(self, request: Request, reply: Message, at: float) -> float:
        """Return how much later than possible a reply came; below 0 if sooner."""
        return at - request.left_soonest - self._wire_time.least(len(reply.encode()))

    def _let_go(self, pending: Request, why: str) -> None:
        """Drop the reply that is held, and go on with the question."""
        if pending.held is not None:
            self._drop(pending.held[0], why)
            pending.held = None
            pending.take(Step.DROP)

    def _may_be_the_lost(self, pending: Request, reply: Message, at: float) -> bool:
        """Return whether the only reply behind one that was lost is too late to be its own."""
        delay = at - pending.left_at - self._wire_time.least(len(reply.encode()))
        unusual = self.pace.is_unusual(type(reply), pending.address, delay, self._step(pending))
        return pending.after_lost and unusual

    def _step(self, request: Request) -> float:
        """Return by how much the time of a reply must differ from others to tell anything."""
        return self._wire_time.seconds(len(request.message.encode())) / 2

    def _learn(self, request: Request, reply: Message, at: float) -> None:
        """Learn from the time of a reply; after one that is too early, wait for the right one."""
        delay, step = self._delay(request, reply, at), self._step(request)
        later = self.pace.answered_in_time(type(reply), request.address, delay, step)
        if later > 0 and step > 0:
            until = at + later + self._wire_time.seconds(len(reply.encode()))
            self.late.expect(self._origin(reply), 1, until, owed=False)

    def _answer(self, request: Request, reply: Message, now: float) -> Answer:
        self._counters.replies += 1
        request.held = None
        self.pending.remove(request)
        if self._wire_time.free_at == request.left_at:
            self._wire_time.seen_idle(now)
        # Which of the attempts it answers is unknown: the others may be answered yet.
        self._expect(request, request.owed - 1, request.deadline)
        return request, reply

    def _origin(self, reply: Message) -> Origin:
        kind = type(reply)
        return Origin((kind,), self._answers[kind].sender(reply))

    def _drop_unsolicited(self, message: Message) -> None:
        origin = self._origin(message)
        self.pace.surplus(origin.address)
        self._drop(message, "it answers nothing that is pending")
        self.late.came(origin)

    def _drop(self, message: Message, why: str) -> None:
        self._counters.unsolicited += 1
        self._log().info("%s: dropped %r: %s", self._name, message, why)
