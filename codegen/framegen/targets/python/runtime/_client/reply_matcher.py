"""Which of the replies that come is the answer, which is held, late, or unsolicited.

No frame says which request it answers. A reply has the class that answers the pending question, and
holds nothing that was not requested. A message of such a class that is no reply to it is
**unsolicited**: it is counted, dropped, and never taken for anything else.

A reply must be possible. It cannot be complete before the question and itself have had their time
on the wire. A reply that is complete sooner was meant for somebody else, as when the reply before
came twice, or much too late; or the line is no wire of the stated rate. It is **held** for one
reply time. If a second one comes, that is the answer, and the first is unsolicited. If none comes,
what is known of the line decides: see Pace. Of several replies that are read at once, the last is
the answer. And after a reply that is possible, but sooner than is usual on this line, the next
question of its kind waits a moment, so that the right one, if there is another, is not taken for
the reply to that.

After a question has timed out, or was cancelled, or the line was lost, its reply may still come
**late**, and would look like the reply to the next question of the same kind. So the next waits,
unsent, until that reply has come, or until the time that the question was given has passed once
more. That time begins when the question is given up, which may be long after its deadline if the
whole machine has paused, and the reply with it. If it has not come by then, it may come yet, so the
reply to the next is held, too.
"""

from __future__ import annotations

from .._log import log
from .exchanges import EXCHANGES
from .late_replies import LateReplies
from .pace import Pace
from .request import Step

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import TypeAlias

    from .._codec.counters import LineCounters
    from .._frame.message import Message
    from .request import Request
    from .wire_time import WireTime

    Answer: TypeAlias = tuple[Request, Message]

_REPLIES = frozenset(each.reply for each in EXCHANGES.values() if each.reply is not None)


class ReplyMatcher:
    """Knows the request that is pending, and what has come and may come for it and for others.

    `latency` is how long a device takes at most until it begins to answer.
    """

    def __init__(
        self, wire_time: WireTime, counters: LineCounters, latency: float, name: str
    ) -> None:
        self._wire_time = wire_time
        self._counters = counters
        self._latency = latency
        self._name = name
        self.pace = Pace()
        self.late = LateReplies()
        # The question that has been sent, and is not over.
        self.pending: Request | None = None
        # The reply to it that has come last, and when, until it is believed or not.
        self._held: tuple[Message, float] | None = None

    @property
    def holds(self) -> bool:
        """Whether a reply is held."""
        return self._held is not None

    # ------------------------------------------------------------------ sending

    def may_be_mistaken(self, request: Request, now: float) -> bool:
        """Whether a reply to a question might be confused with one that may yet come."""
        reply = request.exchange.reply
        if self.pending is not None:
            return True
        # A further attempt accepts the late reply to an earlier one.
        return reply is not None and not request.attempts and self.late.awaited(reply, now)

    def sent(self, request: Request) -> None:
        """Record that a question has been sent."""
        if request.attempts == 1 and request.exchange.reply is not None:
            request.after_lost = self.late.take_missing(request.exchange.reply)
        self.pending = request

    # ------------------------------------------------------------------ receiving

    def take(self, message: Message, now: float) -> bool:
        """Take in a message, unless it is a report; whether it was taken."""
        pending = self.pending
        # What had come before the question was sent cannot answer it.
        if (
            pending is not None
            and now >= pending.sent_at
            and pending.exchange.answers(pending.message, message)
        ):
            if self._held is not None:
                self._drop_unsolicited(self._held[0])
                pending.after_lost = False
            self._held = message, now
            pending.take(Step.HOLD)
        elif type(message) in _REPLIES:
            self._drop_unsolicited(message)
        else:
            return False
        return True

    def weigh(self) -> Answer | None:
        """Give the reply that is held, if the wire can have carried it: it is the answer."""
        pending, held = self.pending, self._held
        if pending is None or held is None:
            return None
        reply, at = held
        possible = self._delay(pending, reply, at) >= 0
        if (possible or self.pace.fast) and not pending.after_lost:
            if possible:
                self._learn(pending, reply, at)
            return self._answer(pending, reply, at)
        if not possible and not pending.doubted:
            pending.doubted = True
            self._counters.impossible += 1
            log().debug("%s: %r came sooner than the wire allows", self._name, reply)
        return None

    @property
    def held_until(self) -> float:
        """Until when another reply may take the place of one that is held."""
        pending = self.pending
        if pending is None:
            return float("-inf")
        return pending.left_at + self._wire_time.seconds(pending.reply_size) + self._latency

    def decide(self, now: float) -> Answer | None:
        """Give the reply that is held where it is to be believed, since no other has come."""
        pending, held = self.pending, self._held
        if pending is None or held is None:
            return None
        reply, at = held
        paced = self.pace.paced
        if self._delay(pending, reply, at) >= 0:
            self._learn(pending, reply, at)
            return self._answer(pending, reply, now)
        self.pace.answered_too_soon()
        if not paced or self.pace.fast:
            return self._answer(pending, reply, now)
        self._held = None
        pending.take(Step.DROP)
        self._drop(reply, "it came sooner than the wire allows, on a line that keeps its rate")
        return None

    # ------------------------------------------------------------------ giving up

    def retry(self) -> None:
        """Have the pending question wait for a further attempt."""
        if self.pending is not None:
            self.pending.take(Step.RETRY)
            self.pending = None

    def give_up(self, since: float, held_until: float) -> None:
        """Await no longer the reply to the pending question, which may come all the same."""
        pending, held = self.pending, self._held
        self.pending = self._held = None
        if pending is None:
            return
        if held is None:
            self.expect_late(pending, since)
            return
        # The reply that is held may be its own; if not, its own is waited for as long as that is
        # held.
        reply, _ = held
        self._drop(reply, "what it may answer was given up")
        self.late.expect(type(reply), pending.attempts, held_until, owed=False)

    def lose(self) -> None:
        """Forget what is pending: the line is gone."""
        self.pending = self._held = None

    def expect_late(self, request: Request, since: float) -> None:
        """Record that replies may come for as many attempts as a request has had."""
        self._expect(request, request.attempts, since)

    def restart(self) -> None:
        """Begin anew on another line, whose pace nobody knows."""
        self.pace = Pace()

    def _expect(self, request: Request, count: int, since: float) -> None:
        reply = request.exchange.reply
        if count and reply is not None:
            self.late.expect(reply, count, since + (request.deadline - request.left_at))

    def _delay(self, request: Request, reply: Message, at: float) -> float:
        """Return how much later than possible a reply came; below 0 if sooner."""
        return at - request.left_soonest - self._wire_time.least(len(reply.encode()))

    def _learn(self, request: Request, reply: Message, at: float) -> None:
        """Learn from the time of a reply; after one that is too early, wait for the right one."""
        step = self._wire_time.seconds(len(request.message.encode())) / 2
        later = self.pace.answered_in_time(type(reply), self._delay(request, reply, at), step)
        if later > 0 and step > 0:
            until = at + later + self._wire_time.seconds(len(reply.encode()))
            self.late.expect(type(reply), 1, until, owed=False)

    def _answer(self, request: Request, reply: Message, now: float) -> Answer:
        self._counters.replies += 1
        self.pending = self._held = None
        if self._wire_time.free_at == request.left_at:
            self._wire_time.seen_idle(now)
        # Which of the attempts it answers is unknown: the others may be answered yet.
        self._expect(request, request.attempts - 1, request.deadline)
        return request, reply

    def _drop_unsolicited(self, message: Message) -> None:
        self.pace.surplus()
        self._drop(message, "it answers nothing that is pending")
        self.late.came(type(message))

    def _drop(self, message: Message, why: str) -> None:
        self._counters.unsolicited += 1
        log().info("%s: dropped %r: %s", self._name, message, why)
