"""The conversation with a device, without a line and without a clock.

Its driver hands in the bytes that arrive and the time, and takes out the bytes to write. A request
that has a reply is a question. One question is in progress at a time; commands, which nothing
answers, do not wait for it.

How a reply is recognised. It has the class that answers the question, and holds nothing that was
not requested. A message of such a class that is no reply to the question in progress is
unsolicited: it is counted and dropped, and never taken for anything else. All others are reports.

A reply must be possible. It cannot be complete before the question and itself have had their time
on the wire. A reply that is complete sooner was meant for somebody else, as when the reply before
came twice, or much too late; or the line is no wire of the stated rate. It is held for one reply
time. If a second one comes, that is the answer, and the first is unsolicited. If none comes, what
is known of the line decides: see Pace. Of several replies that are read at once, the last is the
answer. And after a reply that is possible, but sooner than is usual on this line, the next question
of its kind waits a moment, so that the right one, if there is another, is not taken for the reply
to that.

A late reply. After a question has timed out, or was cancelled, or the line was lost, its reply may
still come, and would look like the reply to the next question of the same kind. So the next waits,
unsent, until that reply has come, or until the time that the question was given has passed once
more. That time begins when the question is given up, which may be long after its deadline if the
whole machine has paused, and the reply with it. If it has not come by then, it may come yet, so
the reply to the next is held, too. For the same reason a line that has just been opened is left to
settle: a program that was killed may have sent a question before us.

A gap. Bytes of one frame follow each other at once. If the line is quiet for longer than GAP in the
middle of a frame, the rest of that frame is lost; see CarefulDecoder.
"""

from __future__ import annotations

from collections import deque
from copy import copy

from .._codec.careful_decoder import GAP, CarefulDecoder
from .._codec.counters import LineCounters
from .._codec.noise import Noise
from .._frame.direction import RECEIVED
from .._log import log
from .._serial.link_errors import EchoError, NoReplyError
from .acknowledgements import Acknowledgements
from .exchanges import EXCHANGES, LIMITS
from .late_replies import LateReplies
from .local_echo import EchoWatch, LocalEcho
from .pace import Pace
from .reports import ReportLog
from .request import Request, Sent, check_room
from .settling import Settling
from .wire_time import WireTime

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Sequence

    from .._frame.message import Message
    from .limits import Bounds
    from .trace import Trace

# How long before the line is free the next frame is handed over, so that it is never idle. More
# would be lag that nobody sees.
_AHEAD = 0.004
# A device that answers at all has begun to do so by then: how long a doubtful reply is held, and
# how long a line settles, however long the reply timeout.
_LATENCY = 0.25
# How long a port may take to accept a frame: longer than a write takes until it fails.
_WRITING = 1.5
_REPLIES = frozenset(each.reply for each in EXCHANGES.values() if each.reply is not None)


class Session:
    """One end of a line. Times are seconds on any clock that never goes back.

    `reply_timeout` is how long the device may take for a reply, beyond the time on the wire, and
    `limits` the lowest and the highest value that is sent in fields that have limits. `local_echo`
    says that the line returns what is sent; `settle` is for how many seconds no question is sent on
    a line that has just been opened, None for one reply time if that may matter.
    """

    def __init__(
        self,
        *,
        baud: float,
        reply_timeout: float,
        report_limit: int,
        trace: Trace | None = None,
        limits: Bounds | None = None,
        local_echo: bool = False,
        settle: float | None = None,
        name: str = "the line",
        now: float = float("-inf"),
    ) -> None:
        if not reply_timeout > 0:
            raise ValueError(f"reply_timeout is {reply_timeout!r}, and must be above 0 seconds")
        self.wire_time = WireTime(baud)
        self.counters = LineCounters()
        self.reports = ReportLog(report_limit)
        self.acknowledgements = Acknowledgements(self.wire_time, reply_timeout)
        # Reports for callbacks, to be taken out by the driver of the session.
        self.callback_queue: deque[Message] = deque(maxlen=report_limit)
        # The longest frame that the line carries; None for any.
        self.largest_frame: int | None = None
        self._reply_timeout = reply_timeout
        # How long a device takes at most until it begins to answer.
        self._latency = min(reply_timeout, _LATENCY)
        self._limits = limits
        self._name = name
        self._trace = trace
        self._settling = Settling(settle, now)
        self._pace = Pace()
        self._echo = LocalEcho() if local_echo else None
        self._echo_watch = EchoWatch()
        self._decoder = CarefulDecoder(RECEIVED)
        self._queue: deque[Request] = deque()
        self._asked: Request | None = None
        # The latest reply to the question in progress, and when it came, until it is believed or
        # not.
        self._held: tuple[Message, float] | None = None
        self._late = LateReplies()
        self._heard_at = float("-inf")
        # When the message came that the decoder is in doubt of.
        self._doubted_at = float("-inf")

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to send, and no reply to wait for."""
        echoing = self._echo is not None and self._echo.due is not None
        return not self._queue and self._asked is None and not echoing

    def submit(
        self,
        message: Message,
        *,
        question: bool | None = None,
        retries: int = 0,
        latest: bool = False,
    ) -> Request:
        """Add a message to the queue, and return its request.

        Raises EncodeError if no reply could answer it, LimitError if the limits forbid it. With
        `question`, TypeError is raised if that is not whether it has a reply.
        """
        exchange = EXCHANGES.get(type(message))
        if exchange is None:
            raise TypeError(f"{message!r} is nothing that this end sends")
        if question is False and exchange.reply is not None:
            raise TypeError(f"{message!r} is a question: request() sends it and awaits the reply")
        if question is True and exchange.reply is None:
            raise TypeError(f"{message!r} is a command: send() sends it, and nothing answers")
        exchange.check(message)
        LIMITS.check(message, self._limits)
        check_room(message, self.largest_frame)
        request = Request(message, exchange, retries=retries, latest=latest)
        self._settling.submitted(question=exchange.reply is not None)
        if latest:
            self._replace(message)
        self._queue.append(request)
        return request

    def cancel(self, request: Request) -> None:
        """Take a request back if it has not been sent, and stop waiting for its reply if it has."""
        if request.done:
            return
        if request is self._asked:
            self._give_up(request, request.deadline)
        elif request in self._queue:
            self._queue.remove(request)
            self._remember(request, request.deadline)
        request.done = True

    def outgoing(self, now: float) -> list[bytes]:
        """Return the frames to write now, in order. Their requests are then in progress."""
        self._late.forget(now)
        frames: list[bytes] = []
        while now >= self.wire_time.free_at - _AHEAD:
            request = self._next(now)
            if request is None:
                break
            self._queue.remove(request)
            frames.append(self._put(request, now))
        return frames

    @property
    def unwritten(self) -> Request | None:
        """The question in progress, until `written` is called for it."""
        return None if self._asked is None or self._asked.written else self._asked

    def written(self, request: Request, now: float) -> None:
        """Record that the port has the frame of a question only at `now`, however long it took.

        The time that the device has for its reply begins then.
        """
        if request is not self._asked or request.written:
            return
        request.written = True
        left_at = max(request.left_at, now + self.wire_time.seconds(len(request.message.encode())))
        if self.wire_time.free_at == request.left_at:
            self.wire_time.free_at = left_at
        request.deadline += left_at - request.left_at
        request.left_at = left_at

    def receive(self, data: bytes, now: float) -> None:
        """Take in bytes that had arrived by `now`."""
        if not data:
            return
        self._heard_at = max(self._heard_at, now)
        self._settling.heard()
        self.acknowledgements.delay(len(data))
        if self._echo is not None:
            data, came, lost = self._echo.take_out(data)
            for request in lost:
                self._echo_lost(request)
            for request in came:
                self._echo_came(request)
        self._decode(data, now)

    def tick(self, now: float) -> None:
        """Advance the time to `now`; all that arrived before must have been received."""
        if self._decoder.pending and now >= self._heard_at + GAP:
            # The line is quiet: half a frame must not grow together with the next one.
            self._flush()
        if self._echo is not None:
            held, lost = self._echo.expire(now)
            if held:
                self._decode(held, self._heard_at)
            for request in lost:
                self._echo_lost(request)
        self._late.forget(now)
        asked = self._asked
        if asked is not None and self._held is not None and now >= self._held_until(asked):
            self._decide(asked, now)
        if self._asked is not None and now >= self._ends_at(self._asked):
            self._expire(self._asked, now)
        if not self._decoder.pending:
            self.acknowledgements.tick(now)

    def send_at(self, now: float) -> float | None:
        """Return when to call `outgoing` again; None while there is nothing to send."""
        if not self._queue:
            return None
        free = self.wire_time.free_at - _AHEAD
        if self._next(now) is not None:
            return free
        times = [*self._late.ends(), *(self._settled_at(request) for request in self._queue)]
        settled = [at for at in times if at > now]
        # A question waits for the one before it, whose end brings the driver back here anyway.
        return max(free, min(settled)) if settled and self._asked is None else None

    @property
    def tick_at(self) -> float | None:
        """The latest time at which to call `tick` again."""
        times: list[float] = []
        if self._asked is not None:
            times.append(self._ends_at(self._asked))
            if self._held is not None:
                times.append(self._held_until(self._asked))
        acknowledged_by = self.acknowledgements.tick_at
        if self._decoder.pending:
            times.append(self._heard_at + GAP)
        elif acknowledged_by is not None:
            times.append(acknowledged_by)
        if self._echo is not None and self._echo.due is not None:
            times.append(self._echo.due)
        if self._queue:
            times += self._late.ends()
        return min(times, default=None)

    def resting_until(self, now: float) -> float:
        """Return until when a reader may sleep, as the rest of a reply takes its time on the wire.

        It misses nothing: the reply is not complete before, a report may wait for so long, and a
        gap is noticed no later for it.
        """
        pending = self._decoder.pending
        if not pending or self._pace.fast:
            return now
        missing = self._decoder.missing
        if self._asked is not None:
            missing = max(missing, self._asked.reply_size - pending)
        arriving = self.wire_time.least(missing - 1)
        return max(now, min(self._heard_at + arriving, self._heard_at + GAP))

    def fail(self, error: Exception) -> None:
        """End everything that is in progress or waiting: the line is gone."""
        waiting = [*([] if self._asked is None else [self._asked]), *self._queue]
        if self._echo is not None:
            waiting += [each for each in self._echo.clear() if each is not self._asked]
        self._queue.clear()
        self._asked = self._held = None
        for request in waiting:
            # The device may answer yet, on the line that is opened next.
            self._remember(request, request.deadline)
            request.finish(error=error)
        # A frame that had begun to arrive will never end, and belongs in the trace.
        self._flush()

    def refuse_questions(self, error: Exception) -> None:
        """End all questions, and leave the commands that are still to be sent."""
        questions = [each for each in self._queue if each.exchange.reply is not None]
        for request in [*([] if self._asked is None else [self._asked]), *questions]:
            self.cancel(request)
            request.finish(error=error)

    def restart(self, now: float) -> None:
        """Begin anew on another line: half a frame of the old one is discarded."""
        self._flush()
        self._decoder = CarefulDecoder(RECEIVED)
        self._pace = Pace()
        self.acknowledgements.restart()
        self.wire_time.clear()
        self._settling.begin(now)
        self._heard_at = float("-inf")

    def _expire(self, asked: Request, now: float) -> None:
        """End a question whose time is over: by a further attempt, or by an error."""
        if self._decoder.pending:
            self._look_behind()
            if self._asked is not asked or self._held is not None:
                return
        self.counters.timeouts += 1
        if not asked.doubted:
            self._pace.not_answered()
        if asked.attempts <= asked.retries:
            self.counters.retries += 1
            self._asked = None
            self._queue.appendleft(asked)
            return
        self._give_up(asked, now)
        waited = now - asked.sent_at
        kind = "" if asked.exchange.reply is None else asked.exchange.reply.__name__
        noise, reports, unsolicited = (
            count - before
            for count, before in zip(self.counters.snapshot(), asked.counted, strict=True)
        )
        noise += self._decoder.pending
        error = NoReplyError(
            asked.message, kind, waited, asked.attempts, noise, reports, unsolicited
        )
        asked.finish(error=error)

    def _flush(self) -> None:
        """End the frame in progress, if there is one."""
        if self._decoder.pending:
            self._take_in(self._decoder.flush(), self._heard_at)
            if self._trace is not None:
                self._trace.quiet()

    def _look_behind(self) -> None:
        """Decode what a false header holds back; half a frame may still arrive in full."""
        decoder = copy(self._decoder)
        events = decoder.flush()
        if any(not isinstance(event, Noise) for event in events):
            self._decoder = decoder
            self._take_in(events, self._heard_at)
            if self._trace is not None:
                self._trace.quiet()

    def _ends_at(self, asked: Request) -> float:
        """Return the deadline of a question: its time has not even begun before the port has it."""
        return self._unless_arriving(asked.deadline + (0.0 if asked.written else _WRITING))

    def _held_until(self, asked: Request) -> float:
        """Return until when another reply may take the place of the one that is held."""
        reply = self.wire_time.seconds(asked.reply_size)
        return self._unless_arriving(asked.left_at + reply + self._latency)

    def _unless_arriving(self, until: float) -> float:
        """Return a time that is up; a little later if a frame is just arriving."""
        return max(until, min(self._heard_at, until) + GAP) if self._decoder.pending else until

    def _settled_at(self, request: Request) -> float:
        """Return until when a question is held back, because replies to others may come first."""
        if request.exchange.reply is None:
            return float("-inf")
        size = len(request.message.encode()) + request.reply_size
        return self._settling.until(self.wire_time.seconds(size) + self._latency)

    def _next(self, now: float) -> Request | None:
        """Return the first request in the queue that may be sent now."""
        for request in self._queue:
            reply = request.exchange.reply
            if reply is None:
                return request
            # A further attempt accepts the late reply to an earlier one.
            unsettled = not request.attempts and self._late.awaited(reply, now)
            if self._asked is None and not unsettled and now >= self._settled_at(request):
                return request
        return None

    def _put(self, request: Request, now: float) -> bytes:
        frame = request.message.encode()
        starts = self.wire_time.take(len(frame), now)
        request.left_at = self.wire_time.free_at
        request.attempts += 1
        request.written = False
        self.counters.sent += 1
        if self._trace is not None:
            self._trace.sent(request.message, now)
        if request.exchange.reports:
            self.reports.caused(request.message, request.exchange.reports)
        if self._echo is not None:
            until = request.left_at + self._latency
            self._echo.sent(request, frame, until)
        else:
            self._echo_watch.sent(frame)
        if request.exchange.reply is None:
            delay, duration = starts - now, self.wire_time.seconds(len(frame))
            sent = Sent(request.message, delay, duration)
            if request.exchange.acknowledged is not None:
                sent = self.acknowledgements.expect(request, delay, duration)
            if self._echo is None:
                request.finish(sent=sent)
            else:
                request.sent = sent  # done once its echo has come
            return frame
        if request.attempts == 1:
            request.sent_at = now
            # A further attempt accepts the late reply to an earlier one.
            request.left_soonest = self.wire_time.free_soonest
            request.counted = self.counters.snapshot()
            request.after_lost = self._late.take_missing(request.exchange.reply)
        answer = self.wire_time.seconds(request.reply_size)
        request.deadline = request.left_at + answer + self._reply_timeout
        self._asked = request
        self._settling.asked()
        return frame

    def _decode(self, data: bytes, now: float) -> None:
        """Decode `data`, and handle the messages; one that was in doubt is older than `now`."""
        doubted, events = self._decoder.doubted, self._decoder.feed(data)
        if doubted is not None and events and events[0] is doubted:
            self._take_in([events.pop(0)], self._doubted_at)
        if self._decoder.doubted is not doubted:
            self._doubted_at = now
        self._take_in(events, now)

    def _take_in(self, events: Sequence[Message | Noise], now: float) -> None:
        for event in events:
            if self._trace is not None:
                self._trace.received(event, now)
            if isinstance(event, Noise):
                self.counters.noise += len(event.data)
                if self._echo is None and self._echo_watch.comes_back(event.data):
                    self._echo_seen()
            elif self._asked is not None and self._answers(self._asked, event, now):
                if self._held is not None:
                    self._unsolicited(self._held[0])
                    self._asked.after_lost = False
                self._held = event, now
            elif type(event) in _REPLIES:
                self._unsolicited(event)
            else:
                self.counters.reports += 1
                self.reports.add(event)
                self.acknowledgements.add(event)
                self.counters.lost_reports = self.reports.lost
                self.callback_queue.append(event)
        # Only now, since of several replies the last is the answer.
        if self._asked is not None and self._held is not None:
            self._weigh(self._asked, *self._held)

    def _answers(self, asked: Request, message: Message, now: float) -> bool:
        """Return whether it can be the reply: one that came before the question was sent cannot."""
        return now >= asked.sent_at and asked.exchange.answers(asked.message, message)

    def _weigh(self, asked: Request, reply: Message, at: float) -> None:
        """Accept the reply that is held as the answer, if the wire can have carried it by then."""
        possible = self._delay(asked, reply, at) >= 0
        if (possible or self._pace.fast) and not asked.after_lost:
            if possible:
                self._came_in_time(asked, reply, at)
            self._answered(asked, reply, at)
        elif not possible and not asked.doubted:
            asked.doubted = True
            self.counters.impossible += 1
            log().debug("%s: %r came sooner than the wire allows", self._name, reply)

    def _delay(self, asked: Request, reply: Message, at: float) -> float:
        """Return how much later than possible the reply came; below 0 if sooner."""
        return at - asked.left_soonest - self.wire_time.least(len(reply.encode()))

    def _came_in_time(self, asked: Request, reply: Message, at: float) -> None:
        """Learn from the time of a reply; after one that is too early, wait for the right one."""
        step = self.wire_time.seconds(len(asked.message.encode())) / 2
        later = self._pace.answered_in_time(type(reply), self._delay(asked, reply, at), step)
        if later > 0 and step > 0:
            until = at + later + self.wire_time.seconds(len(reply.encode()))
            self._late.expect(type(reply), 1, until, owed=False)

    def _decide(self, asked: Request, now: float) -> None:
        """Believe the reply that is held, or not, since no other has come."""
        if self._held is None:
            return
        reply, at = self._held
        paced = self._pace.paced
        if self._delay(asked, reply, at) >= 0:
            self._came_in_time(asked, reply, at)
            self._answered(asked, reply, now)
            return
        self._pace.answered_too_soon()
        if paced and not self._pace.fast:
            self._held = None
            self._drop(reply, "it came sooner than the wire allows, on a line that keeps its rate")
        else:
            self._answered(asked, reply, now)

    def _answered(self, asked: Request, reply: Message, now: float) -> None:
        self.counters.replies += 1
        self._asked = self._held = None
        if self.wire_time.free_at == asked.left_at:
            self.wire_time.seen_idle(now)
        if asked.attempts > 1:
            # Which of the attempts it answers is unknown: the others may be answered yet.
            self._expect_late(type(reply), asked.attempts - 1, asked, asked.deadline)
        if self._echo is not None and self._echo.expects(asked):
            self._echo.forget(asked)
            asked.finish(error=self._no_echo(asked, "a reply came, and not what it answers"))
        else:
            asked.finish(reply=reply)

    def _unsolicited(self, message: Message) -> None:
        """Count and drop a reply that answers nothing."""
        self._pace.surplus()
        self._drop(message, "it answers nothing that is asked")
        self._late.came(type(message))

    def _drop(self, message: Message, why: str) -> None:
        self.counters.unsolicited += 1
        log().info("%s: dropped %r: %s", self._name, message, why)

    def _echo_came(self, request: Request) -> None:
        self.counters.echoes += 1
        if not request.done and request is not self._asked:
            request.finish(sent=request.sent)

    def _echo_lost(self, request: Request) -> None:
        """End a request whose echo has not come."""
        error = self._no_echo(request, "what was sent has not come back")
        if request is self._asked:
            self._give_up(request, request.deadline)
        elif request.latest:
            log().warning("%s (%r)", error, request.message)  # nobody waits for it
        if not request.done:
            request.finish(error=error)

    def _no_echo(self, request: Request, happened: str) -> EchoError:
        told = f"{happened} ({request.message!r})"
        advice = "see whether the adapter gives back what is sent; if not, leave out local_echo"
        return EchoError(self._name, told, advice)

    def _echo_seen(self) -> None:
        """Warn once that the line returns what is sent, although nobody has said that it would."""
        self.counters.echoes += 1
        if self.counters.echoes == 1:
            log().warning(
                "%s gives back what is sent: say so (local_echo=True, or --local-echo), or else "
                "commands that come back look like reports",
                self._name,
            )

    def _give_up(self, request: Request, since: float) -> None:
        """Stop waiting for a reply, which may come all the same."""
        if self._held is None:
            self._asked = None
            self._remember(request, since)
            return
        # The reply that is held may be its own; if not, its own is waited for as long as that is
        # held.
        until = self._held_until(request)
        reply, _ = self._held
        self._asked = self._held = None
        self._drop(reply, "what it may answer was given up")
        self._late.expect(type(reply), request.attempts, until, owed=False)

    def _remember(self, request: Request, since: float) -> None:
        if request.attempts and request.exchange.reply is not None:
            self._expect_late(request.exchange.reply, request.attempts, request, since)

    def _expect_late(self, kind: type[Message], count: int, request: Request, since: float) -> None:
        self._late.expect(kind, count, since + (request.deadline - request.left_at))

    def _replace(self, message: Message) -> None:
        """Take out the waiting commands of the same class, for the same ids or fewer."""
        covered = _subjects(message)
        for request in [each for each in self._queue if each.latest]:
            if type(request.message) is type(message) and _subjects(request.message) <= covered:
                self._queue.remove(request)
                self.counters.replaced += 1
                request.finish()


def _subjects(message: Message) -> frozenset[int]:
    """Return the ids in a message: the first number of each list element, or of all it has."""
    items = message.SHAPE.items
    if items is None:
        return frozenset(getattr(message, name) for name in message.__match_args__[:1])
    if items.element is None:
        return frozenset(getattr(message, items.name))
    return frozenset(item[0] for item in getattr(message, items.name))
