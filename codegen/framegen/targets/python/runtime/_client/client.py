"""A client of the line for threads: whoever waits also reads, for itself and for all others."""

from __future__ import annotations

import threading
import time
import warnings
import weakref
from contextlib import contextmanager

from .._frame.protocol import BAUD
from .._log import log
from .._serial.error_mapping import ErrorMapping
from .._serial.link_errors import (
    ClosedError,
    IncompleteReplyError,
    NoReportError,
    TransportError,
)
from .exchanges import LIMITS
from .long_question import left_out, parts_of
from .motion import Motion
from .report_filter import ReportFilter
from .request import Run
from .session import Session
from .trace import Trace

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from os import PathLike
    from types import TracebackType
    from typing import Any, TypeVar, overload

    from typing_extensions import Self

    from .._codec.counters import LineCounters
    from .._frame.message import Message
    from .._serial.transport import Transport
    from .limits import Bounds
    from .report_filter import Kinds
    from .request import Request, Sent

    _Reply = TypeVar("_Reply", bound=Message)
    _Second = TypeVar("_Second", bound=Message)
    _Third = TypeVar("_Third", bound=Message)

_PACKAGE = __name__.partition(".")[0]
REPLY_TIMEOUT = 0.25
REPORT_LIMIT = 1024
# How long one read may take, so that whoever waits for something else is not delayed.
POLL_INTERVAL = 0.02
# How long to wait for another thread's notification, which always comes: so that a mistake costs no
# more than this.
_LONGEST_WAIT = 0.25
# How long draining may take, beyond the calculated time of the bytes.
DRAIN_TIMEOUT = 1.0
NEVER_CLOSED = "use the client in a `with`, or call close()"


class Client:
    """A client that sends messages over a transport, matches replies, and keeps reports.

    Safe to share between threads. Nothing blocks for ever: every call ends with its result, or with
    an error, in a time that its arguments and `reply_timeout` bound. Better used in a `with`;
    `close` waits until the last byte is out. A client that is dropped without `close` is closed
    with a ResourceWarning.

    `transport` is anything with the methods of Transport. `baud` is the rate that deadlines and
    pacing are calculated from (math.inf for a line that takes no time), `reply_timeout` the seconds
    that a reply may take beyond its time on the wire, `retries` how often a request without a reply
    is sent again, `trace` a file that every frame is recorded in, for `recordings` and `decode` to
    read (an existing recording is never overwritten: FileExistsError), `report_limit` how many
    reports are kept, `limits` the lowest and the highest value that is sent in fields that have
    limits, None for any. With `background`, a thread listens while nobody waits; without, only
    calls read the line, and `clock` may be of any kind.

    `local_echo` says that the line returns what is sent, as half-duplex adapters do: the echo is
    then expected, compared and dropped, and EchoError raised if it does not come. `settle` is for
    how many seconds after opening no request is sent, so that no reply to an earlier program is
    taken for ours: None for one reply time, if the first message is a request or bytes came before
    it; 0 for not at all.
    """

    def __init__(
        self,
        transport: Transport,
        *,
        baud: float = BAUD,
        reply_timeout: float = REPLY_TIMEOUT,
        retries: int = 0,
        trace: str | PathLike[str] | None = None,
        report_limit: int = REPORT_LIMIT,
        limits: Bounds | None = LIMITS.usual,
        background: bool = True,
        clock: Callable[[], float] = time.monotonic,
        local_echo: bool = False,
        settle: float | None = None,
    ) -> None:
        self._limits = LIMITS.chosen(limits)
        self._transport = ErrorMapping(transport)
        self._name = self._transport.name
        self._retries = retries
        self._clock = clock
        # Whether the clock goes on while a thread sleeps.
        self._real_time = clock is time.monotonic
        self._trace = Trace(self._name, trace)
        self._session = Session(
            baud=baud,
            reply_timeout=reply_timeout,
            report_limit=report_limit,
            trace=self._trace,
            limits=self._limits,
            local_echo=local_echo,
            settle=settle,
            name=self._name,
            now=clock(),
        )
        self._session.largest_frame = self._transport.largest_frame
        # Held for every access to the session, never for a read; acquired again by a signal handler
        # that closes this in the middle of anything. Entered itself, not by one of the conditions:
        # Ctrl-C between acquiring it and returning from that would keep it for ever.
        self._lock = threading.RLock()
        # Notified whenever anything changed.
        self._changed = threading.Condition(self._lock)
        # Each request is waited for on a condition of its own: nobody wakes for another's reply.
        self._asking: list[threading.Condition] = []
        # How many wait, and so read; the listener, which reads for nobody, waits for its turn.
        self._waiters = 0
        self._idle = threading.Condition(self._lock)
        self._reading = False
        self._failure: TransportError | None = None
        self._callbacks: list[Callable[[Message], object]] = []
        self._telling = False
        self._background = background
        self._listener: threading.Thread | None = None
        # Held while the line is reopened: there is one port, so one thread does it for all.
        self._reopening = threading.Lock()
        self._closing = False
        # Which thread closes it, and whether that has been done.
        self._closer: threading.Thread | None = None
        self._closed_now = threading.Event()
        self._listen()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        state = "closed" if self._closing else "failed" if self._failure else "open"
        return f"<{type(self).__name__} on {self._name}, {state}>"

    def __del__(self, warn: Callable[..., None] = warnings.warn) -> None:
        # A client whose construction failed has nothing to close.
        if getattr(self, "_closing", True):
            return
        self._closing = True
        try:
            warn(f"{self._name} was never closed: {NEVER_CLOSED}", ResourceWarning, source=self)
        finally:
            self._transport.close()
            self._trace.close()

    @property
    def closed(self) -> bool:
        """Whether it has been closed at this end."""
        return self._closing

    @property
    def counters(self) -> LineCounters:
        """What has passed on the line so far."""
        return self._session.counters

    def send(self, message: Message) -> Sent:
        """Send a command, as soon as the frames before it have left: no lag builds up unseen.

        Returns when it has been handed over; `delay` of the result is when it will be on the wire.
        The result is a Motion for a command that lasts, and a Run for one that is acknowledged.
        Raises LimitError for values outside the limits, and TransportError.
        """
        request = self._done(message, None)
        if request.sent is None:
            raise AssertionError(f"{message!r} ended without an error, and was not sent")
        return request.sent if request.exchange.lasts is None else self._motion(request)

    def send_latest(self, message: Message) -> None:
        """Send a command when the line is free, unless a newer one replaces it; do not wait.

        It replaces a waiting command of the same class for the same ids, or for fewer. So a stream
        of commands faster than the line is thinned out instead of falling behind. Raises LimitError
        for values outside the limits.
        """
        self._submit_latest(message)

    def request(self, message: Message, *, retries: int | None = None) -> Message:
        """Send a request and return the reply, which may hold less than was requested.

        Raises NoReplyError where none came in time, and TransportError.
        """
        reply = self._done(message, self._retries if retries is None else retries).reply
        if reply is None:
            raise AssertionError(f"{message!r} ended without an error, and without a reply")
        return reply

    def reports(self, timeout: float | None = None) -> Iterator[Message]:
        """Yield the reports as they come, those kept so far first; each goes to one iterator.

        The iterator ends when none has come for `timeout` seconds; without one, when this is
        closed. Reports that nobody takes are kept up to the limit; then the oldest are dropped, and
        counted in `counters.lost_reports`. Raises TransportError once the line is lost.
        """
        while True:
            until = None if timeout is None else self._clock() + timeout
            with self._lock, self._waiting():
                report = self._session.reports.take()
                while report is None and not self._closing:
                    self._check()
                    if until is not None and self._clock() >= until:
                        return
                    self._wait(until)
                    report = self._session.reports.take()
            self._tell()
            if report is None:
                return
            yield report

    def on_report(self, callback: Callable[[Message], object]) -> Callable[[], None]:
        """Call `callback` with every report from now on; return a function that ends that.

        It is called in order, one at a time, in whichever thread has read the report, and may use
        this client. Its exceptions are logged, and do not reach anybody else. As many reports as
        are kept wait for a callback that is slow; then the oldest of them are dropped.
        """
        with self._lock:
            self._callbacks.append(callback)

        def stop() -> None:
            with self._lock:
                if callback in self._callbacks:
                    self._callbacks.remove(callback)

        return stop

    if TYPE_CHECKING:

        @overload
        def wait_for(self, kind: type[_Reply], *, timeout: float, **fields: int) -> _Reply: ...

        @overload
        def wait_for(
            self, kind: tuple[type[_Reply]], *, timeout: float, **fields: int
        ) -> _Reply: ...

        @overload
        def wait_for(
            self, kind: tuple[type[_Reply], type[_Second]], *, timeout: float, **fields: int
        ) -> _Reply | _Second: ...

        @overload
        def wait_for(
            self,
            kind: tuple[type[_Reply], type[_Second], type[_Third]],
            *,
            timeout: float,
            **fields: int,
        ) -> _Reply | _Second | _Third: ...

        @overload
        def wait_for(self, kind: Kinds, *, timeout: float, **fields: int) -> Message: ...

    def wait_for(self, kind: Kinds, *, timeout: float, **fields: int) -> Message:
        """Wait for a report of a class, with these field values, and return it.

        `kind` may be a tuple of classes: the first report of any of them is returned, and a field
        that a class lacks is not compared.

        A report that has already come counts, if it came after the latest command that causes such
        reports (with these values, if any) and satisfied no earlier wait. It remains available to
        reports(). Raises NoReportError after `timeout` seconds, which says what came instead, and
        TransportError.
        """
        wanted = ReportFilter(kind, fields)
        began = self._clock()
        with self._lock, self._waiting():
            log = self._session.reports
            asked_at = log.next_number
            since = log.since(wanted)
            last = False
            while True:
                found = log.find(wanted, since=since, asked_at=asked_at)
                if found is not None or last:
                    break
                self._check()
                # One more look after the time is up: what has arrived by then has come in time.
                last = self._clock() >= began + timeout
                self._wait(self._clock() if last else began + timeout)
            instead = log.instead_of(wanted, since=since)
        self._tell()
        if found is None:
            raise NoReportError(str(wanted), self._clock() - began, instead)
        return found

    def close(self) -> None:
        """Send what still waits to be sent, wait until the last byte is out, and close the line.

        Requests of other threads end with ClosedError. May be called again, and by several threads
        at once: each of them returns once the line is closed.
        """
        with self._lock:
            closer, self._closing = self._closer, True
            if closer is None:
                self._closer = threading.current_thread()
        if closer is not None:
            # Whoever closes waits for the listener, and no thread can wait for itself.
            if threading.current_thread() not in (closer, self._listener):
                self._closed_now.wait()
            return
        try:
            self._end()
        finally:
            self._closed_now.set()

    def reconnect(self) -> None:
        """Open the same port again after the line was lost; all that was in progress has failed.

        Reports, callbacks and counters are kept. If several threads call it at the same time, it is
        done once. A transport of your own needs a method `reopen()`, which returns the next one.
        Raises TransportError if that fails, and may then be called again.
        """
        before = self._transport
        with self._reopening:
            if self._transport is not before and self._failure is None:
                return
            reopen = self._transport.reopen
            with self._lock:
                if self._closing:
                    raise self._closed()
                lost = TransportError(self._name, "the line is being opened again", "ask again")
                self._fail(lost)
            self._transport.close()
            self._stop_listening()
            try:
                transport = reopen()
            except TransportError as error:
                self._failure = error
                raise
            with self._lock:
                if self._closing:
                    transport.close()
                    raise self._closed()
                self._transport = transport
                self._session.restart(self._clock())
                self._failure = None
            self._listen()

    def _move(self, message: Message, *, latest: bool) -> Motion:
        """Send a command that lasts."""
        return self._motion(self._submit_latest(message) if latest else self._done(message, None))

    def _motion(self, request: Request) -> Motion:
        return Motion(request, self._session.wire_time, self._clock, self._live)

    def _run(self, message: Message) -> Run:
        """Send a command that is acknowledged."""
        sent = self.send(message)
        if not isinstance(sent, Run):
            raise TypeError(f"{message!r} is acknowledged by nothing")
        return sent

    def _live(self, until: float | None) -> None:
        """Let time pass, until then or for a moment less. Raises TransportError."""
        with self._lock, self._waiting():
            self._check()
            self._wait(until)
        self._tell()

    def _submit_latest(self, message: Message) -> Request:
        with self._lock:
            self._check()
            request = self._session.submit(message, question=False, latest=True)
            # Whoever waits for it must learn that it has been sent or replaced.
            request.notify = self._changed.notify_all
            self._send_due()
            self._changed.notify_all()
        return request

    def _ask(self, message: Message, kind: type[_Reply]) -> _Reply:
        """Return the reply to a request, complete. Raises IncompleteReplyError."""
        reply = self._reply(message, kind)
        asked, missing, arrived = left_out(message, reply)
        if missing:
            raise IncompleteReplyError(asked, missing, [reply], arrived)
        return reply

    def _ask_in_parts(
        self, kind: type[Message], reply: type[_Reply], items: Iterable[Any]
    ) -> list[_Reply]:
        """Return the replies to a request that is too long for one. Raises IncompleteReplyError."""
        replies: list[_Reply] = []
        asked, missing, arrived = "", [], []
        for message in parts_of(kind, items):
            got = self._reply(message, reply)
            replies.append(got)
            field, lacks, came = left_out(message, got)
            asked = field or asked
            missing += lacks
            arrived += came
        if missing:
            raise IncompleteReplyError(asked, missing, replies, arrived)
        return replies

    def _exchanged(
        self, kind: type[Message], items: Iterable[Any]
    ) -> list[tuple[Message, Message]]:
        """Return the requests for a long list, each with its reply, complete or not."""
        return [(each, self.request(each)) for each in parts_of(kind, items)]

    def _reply(self, message: Message, kind: type[_Reply]) -> _Reply:
        reply = self.request(message)
        if not isinstance(reply, kind):
            raise TypeError(f"{message!r} is answered by {type(reply).__name__}")
        return reply

    def _done(self, message: Message, retries: int | None) -> Request:
        """Submit a message, a command where `retries` is None, and wait until it is done."""
        with self._lock, self._waiting():
            self._check()
            request = self._session.submit(
                message, question=retries is not None, retries=retries or 0
            )
            answered = threading.Condition(self._lock)
            request.notify = answered.notify
            try:
                while not request.done:
                    self._wait(None, answered)
            finally:
                self._session.cancel(request)
            failure = self._failure
        self._tell()
        if request.reply is None and failure is not None:
            # A command whose frame the port did not take counts as done, but is not.
            raise failure.again()
        if request.error is not None:
            error = request.error
            raise error.again() if isinstance(error, TransportError) else error
        return request

    @contextmanager
    def _waiting(self) -> Iterator[None]:
        """Enclose calls of `_wait`: at the end another waiter must read. Needs the lock."""
        self._waiters += 1
        try:
            yield
        finally:
            self._waiters -= 1
            self._hand_over()

    def _hand_over(self) -> None:
        """Wake one of the waiting threads, to read for all, unless one reads already."""
        if not self._reading:
            next(iter(self._asking), self._changed).notify()

    def _wait(self, until: float | None, answered: threading.Condition | None = None) -> None:
        """Let something happen: send what is due, then read or let another thread read.

        Returns soon, whether or not anything happened. The lock is held, and released meanwhile.
        `answered` is notified when the request that is waited for is done.
        """
        if self._send_due():
            return
        now = self._clock()
        longest = _LONGEST_WAIT if self._reading else POLL_INTERVAL
        times = [now + longest, self._session.send_at(now), until]
        pause = max(0.0, min(time for time in times if time is not None) - now)
        if self._reading:
            if answered is None:
                self._changed.wait(pause)
                return
            self._asking.append(answered)
            try:
                answered.wait(pause)
            finally:
                self._asking.remove(answered)
            return
        tick_at = self._session.tick_at
        if tick_at is not None:
            pause = max(0.0, min(pause, tick_at - now))
        self._read(pause)

    def _read(self, timeout: float) -> None:
        """Read once, for everyone. What had arrived before counts before any deadline does."""
        transport, began = self._transport, self._clock()
        failure: TransportError | None = None
        data, arrived = b"", began
        # Single bytes are not worth waking up for, each by itself.
        rest = self._session.resting_until(began) - began if self._real_time else 0.0
        self._reading = True
        self._lock.release()
        try:
            if rest > 0:
                time.sleep(min(rest, timeout))
                began = self._clock()
                timeout = max(0.0, timeout - rest)
            data = transport.read(timeout)
            arrived = self._clock()
        except TransportError as error:
            failure = error
        finally:
            self._lock.acquire()
            self._reading = False
        if transport is not self._transport:
            return
        if failure is not None:
            self._fail(failure)
            return
        reports = self._session.counters.reports
        self._session.receive(data, arrived)
        self._session.tick(began)
        if self._session.counters.reports != reports:
            self._changed.notify_all()
            self._idle.notify()
        # The next request of this thread need not be waited for.
        self._send_due()

    def _send_due(self) -> bool:
        """Write what is due; return whether there was anything."""
        frames = self._session.outgoing(self._clock())
        for frame in frames:
            try:
                self._transport.write(frame)
            except TransportError as error:
                self._fail(error)
                return True
        asked = self._session.unwritten
        if asked is not None:
            self._session.written(asked, self._clock())
        if self._session.acknowledgements.unwritten:
            self._session.acknowledgements.written(self._clock())
        return bool(frames)

    def _end(self) -> None:
        try:
            with self._lock:
                self._session.refuse_questions(self._closed())
                self._changed.notify_all()
                self._drain()
                left = max(0.0, self._session.wire_time.free_at - self._clock())
            if self._failure is None:
                self._transport.drain(min(left, DRAIN_TIMEOUT) + DRAIN_TIMEOUT)
        except TransportError as error:
            log().debug("%s could not be drained: %s", self._name, error)
        finally:
            # Whatever interrupts the wait, the port is closed.
            self._transport.close()
            self._stop_listening()
            # A reconnection in progress finds the client closed, and closes the port.
            if self._reopening.acquire(timeout=DRAIN_TIMEOUT):
                self._reopening.release()
            with self._lock:
                self._session.fail(self._closed())
                self._changed.notify_all()
            self._trace.close()

    def _drain(self) -> None:
        """Send all commands that wait, and let their time on the wire pass."""
        until = self._clock() + DRAIN_TIMEOUT
        while self._failure is None:
            # What is due goes first, even if the machine has paused for longer than that.
            self._send_due()
            now = self._clock()
            free_at = self._session.wire_time.free_at
            sent = self._session.idle and now >= free_at
            if sent or now >= max(until, free_at + DRAIN_TIMEOUT):
                return
            self._wait(None if not self._session.idle else free_at)

    def _fail(self, error: TransportError) -> None:
        if self._failure is None:
            self._failure = error
            self._session.fail(error)
        self._changed.notify_all()

    def _check(self) -> None:
        if self._closing:
            raise self._closed()
        if self._failure is not None:
            raise self._failure.again()

    def _closed(self) -> ClosedError:
        return ClosedError(self._name, "it has been closed", "open it again")

    def _tell(self) -> None:
        """Call the callbacks for the reports that have come, unless another thread does."""
        while True:
            with self._lock:
                if self._telling or not self._session.callback_queue:
                    return
                report = self._session.callback_queue.popleft()
                callbacks = list(self._callbacks)
                self._telling = True
            try:
                for callback in callbacks:
                    _call(callback, report)
            finally:
                with self._lock:
                    self._telling = False

    def _listen(self) -> None:
        if self._background:
            step = weakref.WeakMethod(self._listen_once)
            name = f"{_PACKAGE} on {self._name}"
            self._listener = threading.Thread(target=repeat, args=(step,), name=name, daemon=True)
            self._listener.start()

    def _listen_once(self) -> bool:
        """Read if nobody else does, so that reports are received and late commands sent."""
        with self._lock:
            if self._closing or self._failure is not None:
                return False
            if self._listener is not threading.current_thread():
                return False  # it has reconnected, from within a callback, and has a successor
            if self._waiters:
                self._idle.wait(POLL_INTERVAL)
            else:
                try:
                    self._wait(None)
                finally:
                    self._hand_over()
        self._tell()
        return True

    def _stop_listening(self) -> None:
        listener = self._listener
        if listener is not None and listener is not threading.current_thread():
            listener.join(DRAIN_TIMEOUT)


def repeat(step: weakref.WeakMethod[Callable[..., bool]], *arguments: object) -> None:
    """Call a method until it returns False, or until only this still refers to its object."""
    while (call := step()) is not None and call(*arguments):
        del call


def _call(callback: Callable[[Message], object], report: Message) -> None:
    try:
        callback(report)
    except Exception:
        logger = log()
        logger.exception("%r failed on %r", callback, report)
