"""The conversation with a controller, without a line and without a clock.

Whoever drives it hands in the bytes that arrive and the time, and takes out the bytes to write. One
question is under way at a time; commands, which nothing answers, do not wait for it.

How a reply is known. It has the class that answers the request, and tells of nothing that was not
asked. A message of such a class that is no reply to what is under way answers nothing: it is
counted as a stray and dropped, and never taken for anything else. Everything else is a report.

A late reply. After a request has timed out, or was cancelled, or the line was lost, its reply may
still come, and would look like the reply to the next request of the same kind. So the next waits,
unsent, until that reply has come and gone, or until it is overdue by as long again as the request
was given. That time begins when the request is given up, which may be long after its deadline where
the whole machine has paused, and the reply with it.
"""

from __future__ import annotations

from collections import deque
from copy import copy
from typing import TYPE_CHECKING

from .acknowledgements import Acknowledgements
from .counters import LineCounters
from .decoder import StreamDecoder
from .exchanges import EXCHANGES, RECEIVED
from .link_errors import NoReplyError
from .noise import Noise
from .reports import ReportLog
from .request import Request, Sent
from .wire import Wire

if TYPE_CHECKING:
    from .message import Message
    from .tap import Tap

# How long before the line is free the next frame is handed over, so that it is never idle. More
# would be lag that nobody sees.
_AHEAD = 0.004
# How long a port may take to accept a frame: longer than it takes until it is said to be stuck.
_WRITING = 1.5
_REPLIES = frozenset(each.reply for each in EXCHANGES.values() if each.reply is not None)


class _Overdue:
    """Replies of one kind that may still come although nobody waits for them any more."""

    __slots__ = ("count", "kind", "until")

    def __init__(self, kind: type[Message], count: int, until: float) -> None:
        self.kind = kind
        self.count = count
        self.until = until


class Session:
    """One end of a line. Times are seconds on any clock that never goes back.

    `margin` is how long the controller may take for an answer, besides the time on the wire.
    """

    def __init__(
        self, *, baud: float, margin: float, report_limit: int, tap: Tap | None = None
    ) -> None:
        if not margin > 0:
            raise ValueError(f"the margin is {margin!r}, and must be above 0 seconds")
        self.wire = Wire(baud)
        self.counters = LineCounters()
        self.reports = ReportLog(report_limit)
        self.acknowledgements = Acknowledgements(self.wire, margin)
        # Reports for callbacks, to be taken out by whoever drives the session.
        self.news: deque[Message] = deque(maxlen=report_limit)
        self._margin = margin
        self._tap = tap
        self._decoder = StreamDecoder(RECEIVED)
        self._queue: deque[Request] = deque()
        self._asked: Request | None = None
        self._overdue: list[_Overdue] = []
        self._heard_at = float("-inf")

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to send, and no reply to wait for."""
        return not self._queue and self._asked is None

    def submit(
        self,
        message: Message,
        *,
        question: bool | None = None,
        retries: int = 0,
        latest: bool = False,
    ) -> Request:
        """Asks for a message to be sent. Raises EncodeError where no reply could answer it.

        With `question`, TypeError is raised where it has no reply, or has one against expectation.
        """
        exchange = EXCHANGES.get(type(message))
        if exchange is None:
            raise TypeError(f"{message!r} is nothing that this end sends")
        if question is False and exchange.reply is not None:
            raise TypeError(f"{message!r} is a question: request() sends it and awaits the reply")
        if question is True and exchange.reply is None:
            raise TypeError(f"{message!r} is a command: send() sends it, and nothing answers")
        exchange.check(message)
        request = Request(message, exchange, retries=retries, latest=latest)
        if latest:
            self._replace(message)
        self._queue.append(request)
        return request

    def cancel(self, request: Request) -> None:
        """Takes back what has not been sent, and no longer waits for the reply of what has."""
        if request.done:
            return
        if request is self._asked:
            self._give_up(request, request.deadline)
        else:
            self._queue.remove(request)
            self._remember(request, request.deadline)
        request.done = True

    def outgoing(self, now: float) -> list[bytes]:
        """The frames to write now, in order. Those of requests are then under way."""
        frames: list[bytes] = []
        while now >= self.wire.free_at - _AHEAD:
            request = self._next(now)
            if request is None:
                break
            self._queue.remove(request)
            frames.append(self._put(request, now))
        return frames

    @property
    def unwritten(self) -> Request | None:
        """The question under way, until `written` has been told of it."""
        return None if self._asked is None or self._asked.written else self._asked

    def written(self, request: Request, now: float) -> None:
        """Takes in that the port has the frame of a question only `now`, however long it took.

        The time that the controller has for its answer begins then.
        """
        if request is not self._asked or request.written:
            return
        request.written = True
        left_at = max(request.left_at, now + self.wire.seconds(len(request.message.encode())))
        if self.wire.free_at == request.left_at:
            self.wire.free_at = left_at
        request.deadline += left_at - request.left_at
        request.left_at = left_at

    def receive(self, data: bytes, now: float) -> None:
        """Takes in bytes that have arrived."""
        if data:
            self._heard_at = now
            self.acknowledgements.delay(len(data))
            self._take_in(self._decoder.feed(data), now)

    def tick(self, now: float) -> None:
        """Takes in that it is `now`, and that all which arrived before has been received."""
        asked = self._asked
        expired = asked is not None and now >= self._ends_at(asked)
        if self._decoder.pending and now - self._heard_at >= self._margin:
            # The line has gone quiet: half a frame must not grow together with the next reply.
            self._take_in(self._decoder.flush(), now)
        elif self._decoder.pending and expired:
            self._look_behind(now)
        if not self._decoder.pending:
            self.acknowledgements.tick(now)
        self._overdue = [each for each in self._overdue if each.until > now]
        if asked is None or not expired or asked.done:
            return
        self.counters.timeouts += 1
        if asked.attempts <= asked.retries:
            self.counters.retries += 1
            self._asked = None
            self._queue.appendleft(asked)
            return
        self._give_up(asked, now)
        waited = now - asked.sent_at
        kind = "" if asked.exchange.reply is None else asked.exchange.reply.__name__
        asked.finish(error=NoReplyError(asked.message, kind, waited, asked.attempts))

    def send_at(self, now: float) -> float | None:
        """When to call `outgoing` again; None while there is nothing to send."""
        if not self._queue:
            return None
        free = self.wire.free_at - _AHEAD
        if self._next(now) is not None:
            return free
        settled = [each.until for each in self._overdue if each.until > now]
        # A question waits for the one before it, whose end brings the driver back here anyway.
        return max(free, min(settled)) if settled and self._asked is None else None

    @property
    def tick_at(self) -> float | None:
        """When to call `tick` again, at the latest."""
        times = [] if self._asked is None else [self._ends_at(self._asked)]
        acknowledged_by = self.acknowledgements.tick_at
        if self._decoder.pending:
            times.append(self._heard_at + self._margin)
        elif acknowledged_by is not None:
            times.append(acknowledged_by)
        if self._queue:
            times += [each.until for each in self._overdue]
        return min(times, default=None)

    def fail(self, error: Exception) -> None:
        """Ends everything that is under way or waiting: the line is gone."""
        waiting = [*([] if self._asked is None else [self._asked]), *self._queue]
        self._queue.clear()
        self._asked = None
        for request in waiting:
            # The board may answer yet, on the line that is opened next.
            self._remember(request, request.deadline)
            request.finish(error=error)

    def refuse_questions(self, error: Exception) -> None:
        """Ends what waits for replies, and leaves the commands that are still to be sent."""
        questions = [each for each in self._queue if each.exchange.reply is not None]
        for request in [*([] if self._asked is None else [self._asked]), *questions]:
            self.cancel(request)
            request.finish(error=error)

    def restart(self) -> None:
        """Begins anew on another line: half a frame of the old one is forgotten."""
        self._take_in(self._decoder.flush(), self._heard_at)
        self._decoder = StreamDecoder(RECEIVED)
        self.acknowledgements.restart()
        self.wire.free_at = float("-inf")

    def _look_behind(self, now: float) -> None:
        """Takes what a false header is holding back; half a frame is left to come in full."""
        decoder = copy(self._decoder)
        events = decoder.flush()
        if any(not isinstance(event, Noise) for event in events):
            self._decoder = decoder
            self._take_in(events, now)

    @staticmethod
    def _ends_at(asked: Request) -> float:
        """When a question is given up: its time has not even begun before the port has it."""
        return asked.deadline + (0.0 if asked.written else _WRITING)

    def _next(self, now: float) -> Request | None:
        """The first in the queue that may go now."""
        for request in self._queue:
            reply = request.exchange.reply
            if reply is None:
                return request
            # A further attempt takes its own late reply gladly.
            unsettled = not request.attempts and any(
                each.kind is reply and each.until > now for each in self._overdue
            )
            if self._asked is None and not unsettled:
                return request
        return None

    def _put(self, request: Request, now: float) -> bytes:
        frame = request.message.encode()
        starts = self.wire.take(len(frame), now)
        request.left_at = self.wire.free_at
        request.attempts += 1
        request.written = False
        self.counters.sent += 1
        if self._tap is not None:
            self._tap.sent(request.message, now)
        if request.exchange.reports:
            self.reports.caused(request.message, request.exchange.reports)
        if request.exchange.reply is None:
            delay, duration = starts - now, self.wire.seconds(len(frame))
            if request.exchange.acknowledged is None:
                request.finish(sent=Sent(request.message, delay, duration))
            else:
                request.finish(sent=self.acknowledgements.expect(request, delay, duration))
            return frame
        if request.attempts == 1:
            request.sent_at = now
        answer = self.wire.seconds(request.exchange.reply_size(request.message))
        request.deadline = request.left_at + answer + self._margin
        self._asked = request
        return frame

    def _take_in(self, events: list[Message | Noise], now: float) -> None:
        for event in events:
            if self._tap is not None:
                self._tap.received(event, now)
            if isinstance(event, Noise):
                self.counters.noise += len(event.data)
            elif self._asked is not None and self._answers(self._asked, event):
                self._answered(self._asked, event, now)
            elif type(event) in _REPLIES:
                self._stray(event)
            else:
                self.counters.reports += 1
                self.reports.add(event)
                self.acknowledgements.add(event)
                self.counters.lost_reports = self.reports.lost
                self.news.append(event)

    def _answers(self, asked: Request, message: Message) -> bool:
        return asked.exchange.answers(asked.message, message)

    def _answered(self, asked: Request, reply: Message, now: float) -> None:
        self.counters.replies += 1
        self._asked = None
        if self.wire.free_at == asked.left_at:
            self.wire.seen_idle(now)
        if asked.attempts > 1:
            # Which of the attempts it answers, nobody knows: the others may be answered yet.
            self._expect_late(type(reply), asked.attempts - 1, asked, asked.deadline)
        asked.finish(reply=reply)

    def _stray(self, message: Message) -> None:
        self.counters.strays += 1
        for each in self._overdue:
            if each.kind is type(message):
                each.count -= 1
                if not each.count:
                    self._overdue.remove(each)
                return

    def _give_up(self, request: Request, since: float) -> None:
        """No longer waits for a reply, which may come all the same."""
        self._asked = None
        self._remember(request, since)

    def _remember(self, request: Request, since: float) -> None:
        if request.attempts and request.exchange.reply is not None:
            self._expect_late(request.exchange.reply, request.attempts, request, since)

    def _expect_late(self, kind: type[Message], count: int, request: Request, since: float) -> None:
        until = since + (request.deadline - request.left_at)
        self._overdue.append(_Overdue(kind, count, until))

    def _replace(self, message: Message) -> None:
        """Takes out what waits and would be undone by `message`: the same, for no other servos."""
        covered = _subjects(message)
        for request in [each for each in self._queue if each.latest]:
            if type(request.message) is type(message) and _subjects(request.message) <= covered:
                self._queue.remove(request)
                self.counters.replaced += 1
                request.finish()


def _subjects(message: Message) -> frozenset[int]:
    """What a message is about: the first number of each element of its list, or of all it has."""
    items = message.SHAPE.items
    if items is None:
        return frozenset(getattr(message, name) for name in message.__match_args__[:1])
    if items.element is None:
        return frozenset(getattr(message, items.name))
    return frozenset(item[0] for item in getattr(message, items.name))
