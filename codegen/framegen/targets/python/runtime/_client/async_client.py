"""A client of the line for asyncio: the event loop runs the session, two threads carry bytes."""

from __future__ import annotations

import asyncio
import logging
import threading
import time
import warnings
import weakref
from functools import partial
from queue import SimpleQueue
from typing import TYPE_CHECKING, TypeVar, overload

from .._frame.protocol import BAUD
from .._serial.error_mapping import ErrorMapping
from .._serial.link_errors import ClosedError, IncompleteReplyError, NoReportError, TransportError
from .client import DRAIN_TIMEOUT, NEVER_CLOSED, POLL_INTERVAL, REPLY_TIMEOUT, REPORT_LIMIT, repeat
from .exchanges import LIMITS
from .long_question import left_out, parts_of
from .motion import AsyncMotion
from .report_filter import ReportFilter
from .request import Request, Run
from .session import Session
from .trace import Trace

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable, Iterable
    from os import PathLike
    from types import TracebackType
    from typing import Any, TypeAlias

    from typing_extensions import Self

    from .._codec.counters import LineCounters
    from .._frame.message import Message
    from .._serial.transport import Transport
    from .limits import Bounds
    from .report_filter import Kinds
    from .request import Sent

    # Frames to write, a future to resolve once those before it are written, and None for the end.
    _Outbox: TypeAlias = SimpleQueue[bytes | Request | asyncio.Future[None] | None]

_PACKAGE = __name__.partition(".")[0]
logger = logging.getLogger(_PACKAGE)
# While the loop is busy, work that is due stays due: the reading thread must not spin meanwhile.
_SHORTEST_READ = 0.002
_Reply = TypeVar("_Reply", bound="Message")
_Second = TypeVar("_Second", bound="Message")
_Third = TypeVar("_Third", bound="Message")


class AsyncClient:
    """A client that sends messages over a transport, matches replies, and keeps reports.

    Safe to share between the tasks of one event loop: that in which it is first used. A call that
    is cancelled leaves the line usable for the others. Nothing waits for ever: every call ends with
    its result, or with an error, in a time that its arguments and `reply_timeout` bound. Better
    used in an `async with`; `close` waits until the last byte is out. A client that is dropped
    without `close` is closed with a ResourceWarning.

    `transport` is anything with the methods of Transport; it may block, since threads of its own
    read and write it. The other arguments are those of the client for threads.
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
        local_echo: bool = False,
        settle: float | None = None,
    ) -> None:
        self._limits = LIMITS.chosen(limits)
        self._transport = ErrorMapping(transport)
        self._name = self._transport.name
        self._retries = retries
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
            now=time.monotonic(),
        )
        self._session.largest_frame = self._transport.largest_frame
        self._loop: asyncio.AbstractEventLoop | None = None
        self._threads: list[threading.Thread] = []
        self._outbox: _Outbox = SimpleQueue()
        # When the reading thread should report, at the latest, that time has passed and nothing
        # come.
        self._tick_at: float | None = None
        # Until when nothing that is arriving can be complete.
        self._resting_until = float("-inf")
        self._timer: asyncio.TimerHandle | None = None
        self._watchers: set[asyncio.Future[None]] = set()
        # Futures that wait until the frames before them have been handed over.
        self._handing: set[asyncio.Future[None]] = set()
        self._callbacks: list[Callable[[Message], object]] = []
        self._failure: TransportError | None = None
        # Whether the line is being reopened: there is one port, so one task does it for all.
        self._reopening = asyncio.Lock()
        self._ending: asyncio.Future[None] | None = None

    async def __aenter__(self) -> Self:
        self._start()
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    def __repr__(self) -> str:
        state = "closed" if self.closed else "failed" if self._failure else "open"
        return f"<{type(self).__name__} on {self._name}, {state}>"

    def __del__(self, warn: Callable[..., None] = warnings.warn) -> None:
        # A client whose construction failed has nothing to close.
        if getattr(self, "_ending", True) is not None:
            return
        try:
            warn(f"{self._name} was never closed: {NEVER_CLOSED}", ResourceWarning, source=self)
        finally:
            self._outbox.put(None)
            self._transport.close()
            self._trace.close()

    @property
    def closed(self) -> bool:
        """Whether it has been closed at this end."""
        return self._ending is not None

    @property
    def counters(self) -> LineCounters:
        """What has passed on the line so far."""
        return self._session.counters

    async def send(self, message: Message) -> Sent:
        """Send a command, as soon as the frames before it have left: no lag builds up unseen.

        Returns when it has been handed over; `delay` of the result is when it will be on the wire.
        The result is an AsyncMotion for a command that lasts, and a Run for one that is
        acknowledged. Raises LimitError for values outside the limits, and TransportError.
        """
        request = await self._done(message, None)
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

    async def request(self, message: Message, *, retries: int | None = None) -> Message:
        """Send a request and return the reply, which may hold less than was requested.

        Raises NoReplyError where none came in time, and TransportError.
        """
        done = await self._done(message, self._retries if retries is None else retries)
        if done.reply is None:
            raise AssertionError(f"{message!r} ended without an error, and without a reply")
        return done.reply

    async def reports(self, timeout: float | None = None) -> AsyncIterator[Message]:
        """Yield the reports as they come, those kept so far first; each goes to one iterator.

        The iterator ends when none has come for `timeout` seconds; without one, when this is
        closed. Reports that nobody takes are kept up to the limit; then the oldest are dropped, and
        counted in `counters.lost_reports`. Raises TransportError once the line is lost.
        """
        self._start()
        while True:
            until = None if timeout is None else time.monotonic() + timeout
            report = self._session.reports.take()
            while report is None and not self.closed:
                self._check()
                if until is not None and time.monotonic() >= until:
                    return
                await self._change(until)
                report = self._session.reports.take()
            if report is None:
                return
            yield report

    def on_report(self, callback: Callable[[Message], object]) -> Callable[[], None]:
        """Call `callback` with every report from now on; return a function that ends that.

        It is called in the event loop, in order, and must not block. Its exceptions are logged, and
        do not reach anybody else.
        """
        self._callbacks.append(callback)

        def stop() -> None:
            if callback in self._callbacks:
                self._callbacks.remove(callback)

        return stop

    @overload
    async def wait_for(self, kind: type[_Reply], *, timeout: float, **fields: int) -> _Reply: ...

    @overload
    async def wait_for(
        self, kind: tuple[type[_Reply]], *, timeout: float, **fields: int
    ) -> _Reply: ...

    @overload
    async def wait_for(
        self, kind: tuple[type[_Reply], type[_Second]], *, timeout: float, **fields: int
    ) -> _Reply | _Second: ...

    @overload
    async def wait_for(
        self,
        kind: tuple[type[_Reply], type[_Second], type[_Third]],
        *,
        timeout: float,
        **fields: int,
    ) -> _Reply | _Second | _Third: ...

    @overload
    async def wait_for(self, kind: Kinds, *, timeout: float, **fields: int) -> Message: ...

    async def wait_for(self, kind: Kinds, *, timeout: float, **fields: int) -> Message:
        """Wait for a report of a class, with these field values, and return it.

        `kind` may be a tuple of classes: the first report of any of them is returned, and a field
        that a class lacks is not compared.

        A report that has already come counts, if it came after the latest command that causes such
        reports (with these values, if any) and satisfied no earlier wait. It remains available to
        reports(). Raises NoReportError after `timeout` seconds, which says what came instead, and
        TransportError.
        """
        self._start()
        wanted = ReportFilter(kind, fields)
        began = time.monotonic()
        log = self._session.reports
        asked_at = log.next_number
        since = log.since(wanted)
        while True:
            found = log.find(wanted, since=since, asked_at=asked_at)
            if found is not None:
                return found
            self._check()
            waited = time.monotonic() - began
            if waited >= timeout:
                raise NoReportError(str(wanted), waited, log.instead_of(wanted, since=since))
            await self._change(began + timeout)

    async def close(self) -> None:
        """Send what still waits to be sent, wait until the last byte is out, and close the line.

        Requests of other tasks end with ClosedError. May be called again, and by several tasks at
        once: each of them returns once the line is closed. If the event loop in which it was used
        has ended, it may be closed in another.
        """
        if self._ending is None:
            self._ending = asyncio.ensure_future(self._end())
        # It is closed as well if the loop ended in the middle of closing it.
        if not self._ending.cancelled():
            # Once begun, it is completed: half a frame on the line would spoil the next one.
            await asyncio.shield(self._ending)

    async def reconnect(self) -> None:
        """Open the same port again after the line was lost; all that was in progress has failed.

        Reports, callbacks and counters are kept. If several tasks call it at the same time, it is
        done once. A transport of your own needs a method `reopen()`, which returns the next one.
        Raises TransportError if that fails, and may then be called again.
        """
        before = self._transport
        async with self._reopening:
            if self._transport is not before and self._failure is None:
                return
            reopen = self._transport.reopen
            if self.closed:
                raise self._closed()
            self._fail(TransportError(self._name, "the line is being opened again", "ask again"))
            loop = asyncio.get_running_loop()
            await loop.run_in_executor(None, self._shut, 0.0)
            opened = loop.run_in_executor(None, reopen)
            try:
                transport = await asyncio.shield(opened)
            except asyncio.CancelledError:
                opened.add_done_callback(close_late)
                raise
            except TransportError as error:
                self._failure = error
                raise
            if self.closed:
                await loop.run_in_executor(None, transport.close)
                raise self._closed()
            self._transport = transport
            self._session.restart(time.monotonic())
            self._failure = None
            self._loop = None
            self._start()

    async def _move(self, message: Message, *, latest: bool) -> AsyncMotion:
        """Send a command that lasts."""
        if latest:
            return self._motion(self._submit_latest(message))
        return self._motion(await self._done(message, None))

    def _motion(self, request: Request) -> AsyncMotion:
        return AsyncMotion(request, self._session.wire_time, time.monotonic, self._live)

    async def _run(self, message: Message) -> Run:
        """Send a command that is acknowledged."""
        sent = await self.send(message)
        if not isinstance(sent, Run):
            raise TypeError(f"{message!r} is acknowledged by nothing")
        return sent

    async def _live(self, until: float | None) -> None:
        """Let time pass, until then at the latest. Raises TransportError."""
        self._check()
        await self._change(until)

    def _submit_latest(self, message: Message) -> Request:
        self._start()
        request = self._session.submit(message, question=False, latest=True)
        # Whoever waits for it must learn that it has been sent or replaced.
        request.notify = self._wake
        self._advance()
        return request

    async def _ask(self, message: Message, kind: type[_Reply]) -> _Reply:
        """Return the reply to a request, complete. Raises IncompleteReplyError."""
        reply = await self._reply(message, kind)
        asked, missing, arrived = left_out(message, reply)
        if missing:
            raise IncompleteReplyError(asked, missing, [reply], arrived)
        return reply

    async def _ask_in_parts(
        self, kind: type[Message], reply: type[_Reply], items: Iterable[Any]
    ) -> list[_Reply]:
        """Return the replies to a request that is too long for one. Raises IncompleteReplyError."""
        replies: list[_Reply] = []
        asked, missing, arrived = "", [], []
        for message in parts_of(kind, items):
            got = await self._reply(message, reply)
            replies.append(got)
            field, lacks, came = left_out(message, got)
            asked = field or asked
            missing += lacks
            arrived += came
        if missing:
            raise IncompleteReplyError(asked, missing, replies, arrived)
        return replies

    async def _exchanged(
        self, kind: type[Message], items: Iterable[Any]
    ) -> list[tuple[Message, Message]]:
        """Return the requests for a long list, each with its reply, complete or not."""
        return [(each, await self.request(each)) for each in parts_of(kind, items)]

    async def _reply(self, message: Message, kind: type[_Reply]) -> _Reply:
        reply = await self.request(message)
        if not isinstance(reply, kind):
            raise TypeError(f"{message!r} is answered by {type(reply).__name__}")
        return reply

    async def _done(self, message: Message, retries: int | None) -> Request:
        """Submit a message, a command where `retries` is None, and wait until it is done."""
        self._start()
        request = self._session.submit(message, question=retries is not None, retries=retries or 0)
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        request.notify = partial(_set, done)
        self._advance()
        try:
            await done
        finally:
            self._session.cancel(request)
            self._advance()
        if request.error is not None:
            error = request.error
            raise error.again() if isinstance(error, TransportError) else error
        if request.sent is not None:
            await self._handed_over()
            if self._session.acknowledgements.unwritten:
                self._session.acknowledgements.written(time.monotonic(), request.sent)
                self._advance()
        return request

    async def _handed_over(self) -> None:
        """Wait until the port has taken all frames so far. Raises TransportError if it did not."""
        taken: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._handing.add(taken)
        self._outbox.put(taken)
        try:
            # A line that fails releases whoever waits here.
            if self._failure is None:
                await taken
        finally:
            self._handing.discard(taken)
        if self._failure is not None:
            raise self._failure.again()

    def _start(self) -> None:
        """Bind this to the running loop, and start the threads, on first use."""
        self._check()
        loop = asyncio.get_running_loop()
        if self._loop is loop:
            return
        if self._loop is not None:
            raise RuntimeError("this client belongs to another event loop")
        self._loop = loop
        self._outbox = SimpleQueue()
        line = _Connection(self._transport, self._outbox)
        # They hold a reference only while they work, so that the client can end when nobody else
        # has one.
        reading = weakref.WeakMethod(self._read_once)
        written = weakref.WeakMethod(self._session.written)
        lost = weakref.WeakMethod(self._lost)
        self._threads = [
            threading.Thread(target=repeat, args=(reading, loop, line), daemon=True),
            threading.Thread(target=_run_writer, args=(loop, line, written, lost), daemon=True),
        ]
        for thread in self._threads:
            thread.name = f"{_PACKAGE} on {self._name}"
            thread.start()

    def _advance(self) -> None:
        """Send what is due, schedule the next look at the clock, and wake those who wait."""
        now = time.monotonic()
        frames = self._session.outgoing(now)
        for frame in frames:
            self._outbox.put(frame)
        asked = self._session.unwritten
        if frames and asked is not None:
            self._outbox.put(asked)
        self._tick_at = self._session.tick_at
        self._resting_until = self._session.resting_until(now)
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        send_at = self._session.send_at(now)
        if send_at is not None and self._loop is not None and self._failure is None:
            self._timer = self._loop.call_later(max(0.0, send_at - now), self._advance)
        while self._session.callback_queue:
            report = self._session.callback_queue.popleft()
            for callback in list(self._callbacks):
                _call(callback, report)

    def _arrived(self, line: _Connection, data: bytes, began: float, arrived: float) -> None:
        if line.transport is self._transport and self._failure is None:
            reports = self._session.counters.reports
            self._session.receive(data, arrived)
            # What had arrived before counts before any deadline does.
            self._session.tick(began)
            self._advance()
            if self._session.counters.reports != reports:
                self._wake()

    def _lost(self, line: _Connection, error: TransportError) -> None:
        if line.transport is self._transport:
            self._fail(error)

    def _fail(self, error: TransportError) -> None:
        if self._failure is None:
            self._failure = error
            self._session.fail(error)
            self._let_go()

    def _let_go(self) -> None:
        """Wake all who wait: the line has failed."""
        for taken in self._handing:
            _set(taken)
        self._wake()

    def _wake(self) -> None:
        for watcher in self._watchers:
            _set(watcher)

    async def _change(self, until: float | None) -> None:
        """Wait until a report has come or the line has failed, or until a time."""
        watcher: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._watchers.add(watcher)
        try:
            left = None if until is None else max(0.0, until - time.monotonic())
            await asyncio.wait([watcher], timeout=left)
        finally:
            self._watchers.discard(watcher)

    async def _end(self) -> None:
        closed = self._closed()
        self._loop = loop = asyncio.get_running_loop()
        self._session.refuse_questions(closed)
        self._advance()
        self._wake()
        try:
            await self._drain()
            longest = DRAIN_TIMEOUT if self._failure is None else 0.0
            await loop.run_in_executor(None, self._shut, longest)
            await self._given_back()
        except asyncio.CancelledError:
            # The loop is about to end; the port is closed all the same.
            self._shut(0.0)
            raise
        finally:
            self._failure = self._failure or closed
            self._session.fail(closed)
            if self._timer is not None:
                self._timer.cancel()
            self._let_go()
            self._trace.close()

    async def _drain(self) -> None:
        """Wait until all commands have been sent, and have had their time on the wire."""
        until = time.monotonic() + DRAIN_TIMEOUT
        while self._failure is None:
            # What is due goes first, even if the machine has paused for longer than that.
            self._advance()
            now, free_at = time.monotonic(), self._session.wire_time.free_at
            sent = self._session.idle and now >= free_at
            if sent or now >= max(until, free_at + DRAIN_TIMEOUT):
                return
            await asyncio.sleep(min(POLL_INTERVAL, max(0.001, free_at - now)))

    async def _given_back(self) -> None:
        """Wait until a reconnection in progress finds the client closed, and closes the port."""
        until = time.monotonic() + DRAIN_TIMEOUT
        while self._reopening.locked() and time.monotonic() < until:
            await asyncio.sleep(POLL_INTERVAL)

    def _shut(self, timeout: float) -> None:
        """End the threads and close the transport, which may take a moment: not in the loop."""
        self._outbox.put(None)
        for thread in self._threads[1:]:
            thread.join(DRAIN_TIMEOUT)
        try:
            if timeout:
                self._transport.drain(timeout)
        except TransportError as error:
            logger.debug("%s could not be drained: %s", self._name, error)
        finally:
            self._transport.close()
            for thread in self._threads[:1]:
                thread.join(DRAIN_TIMEOUT)

    def _check(self) -> None:
        if self.closed:
            raise self._closed()
        if self._failure is not None:
            raise self._failure.again()

    def _closed(self) -> ClosedError:
        return ClosedError(self._name, "it has been closed", "open it again")

    def _read_once(self, loop: asyncio.AbstractEventLoop, line: _Connection) -> bool:
        """Carry bytes from the transport to the loop; return False once one of them has ended."""
        # Single bytes are not worth waking up for, each by itself.
        rest = self._resting_until - time.monotonic()
        if rest > 0:
            time.sleep(min(rest, POLL_INTERVAL))
        began = time.monotonic()
        tick_at = self._tick_at
        left = POLL_INTERVAL if tick_at is None else tick_at - began
        try:
            data = line.transport.read(min(POLL_INTERVAL, max(_SHORTEST_READ, left)))
            arrived = time.monotonic()
        except TransportError as error:
            _post(loop, self._lost, line, error)
            return False
        return not (data or tick_at is not None) or _post(
            loop, self._arrived, line, data, began, arrived
        )


class _Connection:
    """One connection: what its threads use, while the client may already use the next."""

    __slots__ = ("outbox", "transport")

    def __init__(self, transport: ErrorMapping, outbox: _Outbox) -> None:
        self.transport = transport
        self.outbox = outbox


def _run_writer(
    loop: asyncio.AbstractEventLoop,
    line: _Connection,
    written: weakref.WeakMethod[Callable[[Request, float], None]],
    lost: weakref.WeakMethod[Callable[[_Connection, TransportError], None]],
) -> None:
    """Carry frames from the loop to the transport, until a None comes."""
    while (item := line.outbox.get()) is not None:
        try:
            if isinstance(item, bytes):
                line.transport.write(item)
            elif isinstance(item, Request):
                _post(loop, written(), item, time.monotonic())
            else:
                _post(loop, _set, item)
        except TransportError as error:
            _post(loop, lost(), line, error)
            return


def close_late(opened: asyncio.Future[Any]) -> None:
    """Close a transport that was opened for somebody who no longer waits for it."""
    if not opened.cancelled() and opened.exception() is None:
        opened.result().close()


def _set(future: asyncio.Future[None]) -> None:
    # In a loop that has ended, nobody waits any more.
    if not future.done() and not future.get_loop().is_closed():
        future.set_result(None)


def _post(
    loop: asyncio.AbstractEventLoop, call: Callable[..., None] | None, *arguments: object
) -> bool:
    """Schedule a call in the loop; return False where that or the loop is no more."""
    if call is None:
        return False
    try:
        loop.call_soon_threadsafe(call, *arguments)
    except RuntimeError:
        return False
    return True


def _call(callback: Callable[[Message], object], report: Message) -> None:
    try:
        callback(report)
    except Exception:
        logger.exception("%r failed on %r", callback, report)
