"""The conversation with a device, without a line and without a clock.

Its driver hands in the bytes that arrive and the time, and takes out the bytes to write. A request
that has a reply is a question. One question is pending at a time; commands, which nothing answers,
do not wait for it. Where devices with addresses share a wire, commands wait as well, and a device
that is overdue keeps nobody waiting who is for another. A request goes through these states, by
these steps and no others (`STATES`):

    submit ─▶ WAITING ── SEND ──▶ PENDING ── HOLD ──▶ HELD ─┐ HOLD: another reply
                 ▲                 │   ▲               │ ▲  │ takes its place
                 └────── RETRY ────┘   └───── DROP ────┘ └──┘
    from each: FINISH ─▶ DONE

RequestQueue says which of those that wait may go, ReplyMatcher which reply is held and which is the
answer, FrameReader what the bytes are. This puts them together, and keeps the deadlines.
"""

from __future__ import annotations

from collections import deque

from ..codec.counters import LineCounters
from ..codec.noise import Noise
from ..frame.errors import EncodeError
from ..line.link_errors import DoubtfulReplyError, NoReplyError
from .acknowledgements import Acknowledgements
from .commanded import Commanded
from .frame_reader import FrameReader
from .local_echo import EchoWatch, LocalEcho, echo_error
from .reply_matcher import ReplyMatcher
from .reports import ReportLog
from .request import Request, Sent, Step, check_room
from .request_queue import RequestQueue
from .settling import Settling
from .wire_time import WireTime

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message
    from .exchange import Unaddressed
    from .library import Library
    from .limits import Allowed
    from .reply_matcher import Answer
    from .trace import Trace

# A device that answers at all has begun to do so by then: how long a doubtful reply is held, and
# how long a line settles, however long the reply timeout.
_LATENCY = 0.25
# How long an adapter may take to give back what is sent, however long the reply timeout.
_ECHO_LATENCY = 0.25
# How long a port may take to accept a frame: longer than a write takes until it fails.
_WRITING = 1.5


class Session:
    """One end of a line. Times are seconds on any clock that never goes back.

    `library` says what the messages are and what answers them. `reply_timeout` is how long the
    device may take for a reply, beyond the time on the wire, and `limits` the lowest and the
    highest value that is sent in fields that have limits, for all or by number. `local_echo` says
    that the line returns what is sent; `settle` is for how many seconds no question is sent on a
    line that has just been opened, None for one reply time if that may matter.
    """

    def __init__(
        self,
        library: Library,
        *,
        baud: float,
        reply_timeout: float,
        report_limit: int,
        trace: Trace | None = None,
        limits: Allowed = None,
        local_echo: bool = False,
        settle: float | None = None,
        name: str = "the line",
        now: float = float("-inf"),
    ) -> None:
        if not reply_timeout > 0:
            raise ValueError(f"reply_timeout is {reply_timeout!r}, and must be above 0 seconds")
        self._exchanges = library.exchanges
        self._codec = library.codec
        self._log = library.log
        self.wire_time = WireTime(library.link, baud)
        self.counters = LineCounters()
        self.reports = ReportLog(report_limit)
        self.acknowledgements = Acknowledgements(library, self.wire_time, reply_timeout)
        self.commanded = Commanded(library.pose)
        # Reports for callbacks, to be taken out by the driver of the session.
        self.callback_queue: deque[Message] = deque(maxlen=report_limit)
        # The longest frame that the line carries; None for any.
        self.largest_frame: int | None = None
        self._reply_timeout = reply_timeout
        # How long a device takes at most until it begins to answer.
        self._latency = min(reply_timeout, _LATENCY)
        self._usual_limits = library.limits
        self._limits = limits
        self._name = name
        self._trace = trace
        self._settling = Settling(settle, now)
        self._echo = LocalEcho() if local_echo else None
        self._echo_watch = EchoWatch(library, name, self.counters)
        self._frames_sent = 0
        self._reader = FrameReader(library.codec)
        matcher = ReplyMatcher(library, self.wire_time, self.counters, self._latency, name, now)
        self._matcher = matcher
        self._queue = RequestQueue(self.wire_time, self._settling, matcher, self._latency)

    @property
    def idle(self) -> bool:
        """Whether there is nothing left to send, and no reply to wait for."""
        echoing = self._echo is not None and self._echo.due is not None
        return not self._queue and not self._matcher.pending and not echoing

    # ------------------------------------------------------------------ sending

    def submit(
        self,
        message: Message,
        *,
        question: bool | None = None,
        retries: int = 0,
        latest: bool = False,
        within: float | None = None,
    ) -> Request:
        """Add a message to the queue, and return its request.

        Raises EncodeError if no reply could answer it, LimitError if the limits forbid it. With
        `question`, TypeError is raised if that is not whether it has a reply. With `within`, the
        replies of all who answer in so many seconds are gathered.
        """
        exchange = self._exchanges.get(type(message))
        if exchange is None:
            whose = _whose(message, self._codec)
            raise TypeError(f"{message!r} is nothing that this end sends{whose}")
        silence = exchange.address.silence(message)
        if question is False and exchange.reply is not None and not silence:
            raise TypeError(f"{message!r} is a question: request() sends it and awaits the reply")
        if question is True and exchange.reply is None:
            raise TypeError(f"{message!r} is a command: send() sends it, and nothing answers")
        if question is True and silence and within is None:
            raise _nobody_answers(exchange.address, message)
        exchange.check(message)
        self._usual_limits.check(message, self._limits, exchange.address)
        check_room(message, self.largest_frame)
        request = Request(message, exchange, retries=retries, latest=latest, within=within)
        self._settling.submitted(question=request.question)
        for replaced in self._queue.add(request):
            self.counters.replaced += 1
            replaced.finish()
        return request

    def cancel(self, request: Request, error: Exception | None = None) -> None:
        """Take a request back if it has not been sent, and stop waiting for its reply if it has."""
        if request.done:
            return
        if request in self._matcher.pending:
            self._give_up(request, request.deadline)
        elif request in self._queue:
            self._queue.remove(request)
            self._matcher.expect_late(request, request.deadline)
        request.finish(error=error)

    def outgoing(self, now: float) -> list[bytes]:
        """Return the frames to write now, in order. Their requests are then sent."""
        self._matcher.late.forget(now)
        frames: list[bytes] = []
        while (request := self._queue.take(now)) is not None:
            frames.append(self._put(request, now))
        return frames

    @property
    def unwritten(self) -> Request | None:
        """The pending question, until `written` says that the port has it."""
        return next((each for each in self._matcher.pending if not each.written), None)

    def written(self, request: Request, now: float) -> None:
        """Record that the port has the frame of a question only at `now`, however long it took.

        The time that the device has for its reply begins then.
        """
        if request not in self._matcher.pending or request.written:
            return
        request.written = True
        left_at = max(request.left_at, now + self.wire_time.seconds(len(request.message.encode())))
        if self.wire_time.free_at == request.left_at:
            self.wire_time.free_at = left_at
        request.deadline += left_at - request.left_at
        request.left_at = left_at

    # ------------------------------------------------------------------ receiving

    def receive(self, data: bytes, now: float) -> None:
        """Take in bytes that had arrived by `now`."""
        if not data:
            return
        self._settling.received()
        self.acknowledgements.delay(len(data))
        if self._echo is None:
            self._read(data, now)
            return
        for before, request, lost in self._echo.take_out(data):
            self._read(before, now)
            for each in lost:
                self._echo_lost(each)
            if request is not None:
                self._echo_came(request)

    def tick(self, now: float) -> None:
        """Advance the time to `now`; all that arrived before must have been received."""
        quiet_at = self._reader.quiet_at
        if quiet_at is not None and now >= quiet_at:
            # The line is quiet: half a frame must not grow together with the next one.
            self._flush()
        if self._echo is not None:
            kept, lost = self._echo.expire(now)
            if kept:
                self._read(kept, self._reader.received_at)
            for request in lost:
                self._echo_lost(request)
        self._matcher.late.forget(now)
        for pending in [*self._matcher.pending]:
            if pending.held is not None and now >= self._held_until(pending):
                self._answer(self._matcher.decide(pending, now))
            if pending.rivals:
                self._resolve(pending, now)
            if pending in self._matcher.pending and now >= self._ends_at(pending):
                self._expire(pending, now)
        if not self._reader.pending:
            self.acknowledgements.tick(now)

    # ------------------------------------------------------------------ when to come back

    def send_at(self, now: float) -> float | None:
        """Return when to call `outgoing` again; None while there is nothing to send."""
        return self._queue.send_at(now)

    @property
    def tick_at(self) -> float | None:
        """The latest time at which to call `tick` again."""
        times: list[float] = []
        for pending in self._matcher.pending:
            times.append(self._ends_at(pending))
            if pending.held is not None:
                times.append(self._held_until(pending))
        acknowledged_by = self.acknowledgements.tick_at
        quiet_at = self._reader.quiet_at
        if quiet_at is not None:
            times.append(quiet_at)
        elif acknowledged_by is not None:
            times.append(acknowledged_by)
        if self._echo is not None and self._echo.due is not None:
            times.append(self._echo.due)
        if self._queue:
            times += self._matcher.late.ends()
        return min(times, default=None)

    def resting_until(self, now: float) -> float:
        """Return until when a reader may sleep, since the rest of a reply takes its time.

        It misses nothing: the reply is not complete before, a report may wait for so long, and a
        gap is noticed no later for it.
        """
        quiet_at = self._reader.quiet_at
        if quiet_at is None or self._matcher.pace.fast:
            return now
        missing = self._reader.missing
        if self._matcher.pending:
            least = min(each.reply_least for each in self._matcher.pending)
            missing = max(missing, least - self._reader.pending)
        arriving = self.wire_time.least(missing - 1)
        return max(now, min(self._reader.received_at + arriving, quiet_at))

    # ------------------------------------------------------------------ a line that ends

    def fail(self, error: Exception) -> None:
        """End everything that is pending or waiting: the line is gone."""
        pending = [*self._matcher.pending]
        ended = [*pending, *self._queue.clear()]
        if self._echo is not None:
            ended += [each for each in self._echo.clear() if each not in pending]
        self._matcher.lose()
        for request in ended:
            # The device may answer yet, on the line that is opened next.
            self._matcher.expect_late(request, request.deadline)
            if not request.done:
                request.finish(error=error)
        # A frame that had begun to arrive will never end, and belongs in the trace.
        self._flush()

    def refuse_questions(self, error: Exception) -> None:
        """End all questions, and leave the commands that are still to be sent."""
        questions = [each for each in self._queue if each.question]
        for request in [*self._matcher.pending, *questions]:
            self.cancel(request, error)

    def restart(self, now: float) -> None:
        """Begin anew on another line: half a frame of the old one is discarded."""
        self._flush()
        self._reader.restart()
        self._matcher.restart(now)
        self.acknowledgements.restart()
        self.wire_time.clear()
        self._settling.begin(now)

    # ------------------------------------------------------------------ how a request is sent

    def _put(self, request: Request, now: float) -> bytes:
        if request.exchange.counter is not None:
            self._number(request, *request.exchange.counter)
        frame = request.message.encode()
        starts = self.wire_time.take(len(frame), now)
        request.take(Step.SEND)
        request.left_at = self.wire_time.free_at
        request.attempts += 1
        request.owed += 1
        request.written = False
        self.counters.sent += 1
        self.commanded.sent(request.message)
        if self._trace is not None:
            self._trace.sent(request.message, now)
        if request.exchange.reports:
            self.reports.caused(request.message, request.exchange.reports)
        if self._echo is not None:
            until = request.left_at + min(self._reply_timeout, _ECHO_LATENCY)
            self._echo.sent(request, frame, until)
            request.echo_due = self.counters.echoes > 0
        else:
            self._echo_watch.sent(frame)
        if not request.question:
            delay, duration = starts - now, self.wire_time.seconds(len(frame))
            sent = Sent(request.message, delay, duration)
            if request.exchange.acknowledged is not None:
                sent = self.acknowledgements.expect(request, delay, duration)
            if self._echo is None:
                request.finish(sent=sent)
            else:
                request.sent = sent  # done once its echo has come
            return frame
        self._begin(request, now)
        return frame

    def _begin(self, question: Request, now: float) -> None:
        """Record when a question was sent, and how long it may take."""
        if question.attempts == 1:
            question.sent_at = now
            question.before = self.counters.snapshot()
        if question.owed == 1:
            # A further attempt accepts the late reply to an earlier one.
            question.left_soonest = self.wire_time.free_soonest
        answer = self.wire_time.seconds(question.reply_size)
        question.deadline = question.left_at + answer + self._reply_timeout
        if question.within is not None:
            question.deadline = question.left_at + question.within
        self._matcher.sent(question)
        self._settling.question_sent()

    def _number(self, request: Request, counter: str, numbers: int) -> None:
        """Give a frame its running number."""
        request.message = request.message.__replace__(**{counter: self._frames_sent % numbers})
        self._frames_sent += 1

    # ------------------------------------------------------------------ how it ends

    def _ends_at(self, pending: Request) -> float:
        """Return when a question is given up: its time does not begin before the port has it."""
        until = pending.deadline + (0.0 if pending.written else _WRITING)
        longer = self.wire_time.seconds(pending.reply_room - pending.reply_size)
        return self._reader.unless_arriving(until, longer)

    def _held_until(self, pending: Request) -> float:
        """Return until when another reply may take the place of the one that is held."""
        return self._reader.unless_arriving(self._matcher.held_until(pending))

    def _give_up(self, pending: Request, since: float) -> None:
        if pending.within is None:
            self._matcher.give_up(pending, since, self._held_until(pending))
        else:
            self._matcher.end_gathering(pending, since)

    def _expire(self, pending: Request, now: float) -> None:
        """End a question whose time is over: by a further attempt, or by an error."""
        if self._reader.pending:
            hidden = self._reader.look_behind()
            if hidden:
                self._break_off(hidden)
            if pending not in self._matcher.pending or pending.held is not None:
                return
        if pending.within is not None:
            self._give_up(pending, now)
            pending.finish()
            return
        self.counters.timeouts += 1
        if not pending.doubted:
            self._matcher.pace.not_answered(pending.address)
        if pending.attempts - pending.doubts <= pending.retries:
            self._ask_again(pending)
            return
        self._give_up(pending, now)
        waited = now - pending.sent_at
        kind = "" if pending.exchange.reply is None else pending.exchange.reply.__name__
        noise, reports, unsolicited = (
            count - before
            for count, before in zip(self.counters.snapshot(), pending.before, strict=True)
        )
        noise += self._reader.pending
        error = NoReplyError(
            pending.message, kind, waited, pending.attempts, noise, reports, unsolicited
        )
        pending.finish(error=error)

    def _ask_again(self, pending: Request) -> None:
        self.counters.retries += 1
        self._matcher.retry(pending)
        self._queue.put_back(pending)

    def _resolve(self, pending: Request, now: float) -> None:
        """Ask once more where nothing tells which reply is the answer, or end with them all."""
        repeated = self._matcher.may_be_repeated(pending)
        rivals = self._matcher.set_aside(pending)
        if repeated:
            self._ask_again(pending)
            return
        self._give_up(pending, now)
        waited = now - pending.sent_at
        error = DoubtfulReplyError(pending.message, rivals, waited, pending.attempts)
        pending.finish(error=error)

    def _answer(self, answer: Answer | None) -> None:
        """End a question that has been answered, if one has."""
        if answer is None:
            return
        request, reply = answer
        if self._echo is not None and self._echo.expects(request):
            self._echo.forget(request)
            happened = "a reply came, and not what it answers"
            request.finish(error=echo_error(self._name, happened, request))
        else:
            request.finish(reply=reply)

    def _echo_came(self, request: Request) -> None:
        self.counters.echoes += 1
        request.echo_due = False
        if not request.done and request not in self._matcher.pending:
            request.finish(sent=request.sent)

    def _echo_lost(self, request: Request) -> None:
        """End a request whose echo has not come."""
        error = echo_error(self._name, "what was sent has not come back", request)
        if request in self._matcher.pending:
            self._give_up(request, request.deadline)
        elif request.latest:
            self._log().warning("%s (%r)", error, request.message)  # nobody waits for it
        if not request.done:
            request.finish(error=error)

    # ------------------------------------------------------------------ what the bytes say

    def _read(self, data: bytes, now: float) -> None:
        for at, events in self._reader.read(data, now):
            self._take_in(at, events)
        undecided = self._reader.undecided
        self._reader.is_whole = undecided is not None and self._matcher.ends_with(*undecided, now)

    def _take_in(self, now: float, events: Sequence[Message | Noise]) -> None:
        for event in events:
            if self._trace is not None:
                self._trace.received(event, now)
            if isinstance(event, Noise):
                self.counters.noise += len(event.data)
                if self._echo is None:
                    self._echo_watch.look_at(event.data)
            elif not self._matcher.take(event, now):
                self._report(event)
            for report in self._matcher.take_reports():
                self._report(report)
        # Only now: of several replies that come at once, none is the answer because it is first.
        for answer in self._matcher.weigh():
            self._answer(answer)
        for pending in self._matcher.in_doubt():
            self._resolve(pending, now)

    def _report(self, report: Message) -> None:
        self.counters.reports += 1
        self.reports.add(report)
        self.acknowledgements.add(report)
        self.counters.lost_reports = self.reports.lost
        self.callback_queue.append(report)

    def _flush(self) -> None:
        """End the frame in progress, if there is one."""
        if self._reader.pending:
            self._break_off(self._reader.flush())

    def _break_off(self, events: Sequence[Message | Noise]) -> None:
        """Take in what was held back: what comes next goes on with no frame."""
        self._take_in(self._reader.received_at, events)
        if self._trace is not None:
            self._trace.quiet()


def _whose(message: Message, codec: ProtocolCodec) -> str:
    """Return what to say of a message of another protocol, behind a sentence; else nothing."""
    if isinstance(getattr(message, "DIRECTION", None), codec.directions):
        return ""
    package = type(message).__module__.rpartition(".")[0]
    return f": it is of {package}, and this a client of {codec.package}"


def _nobody_answers(address: Unaddressed, message: Message) -> EncodeError:
    """Return what tells that a question cannot be put to an address."""
    silence, value = address.silence(message), address.of(message)
    why = f"{value} ({silence}) is answered by nobody: ask one device, or gather the replies of all"
    return EncodeError(address.field, value, f"{why} who answer, with `broadcast()`")
