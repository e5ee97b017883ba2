"""The client for asyncio: its calls are awaited, and the loop holds the conversation."""

from __future__ import annotations

import asyncio
import time
from functools import partial
from typing import TYPE_CHECKING, TypeVar, overload

from .._frame.protocol import BAUD
from .._serial.link_errors import TransportError
from .base_client import (
    DRAIN_TIMEOUT,
    POLL_INTERVAL,
    REPLY_TIMEOUT,
    REPORT_LIMIT,
    BaseClient,
)
from .exchanges import LIMITS
from .line_threads import LineThreads, settle
from .motion import AsyncMotion
from .polled_line import PolledLine
from .request import Request

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable, Iterable
    from os import PathLike
    from types import TracebackType
    from typing import Any

    from typing_extensions import Self

    from .._frame.message import Message
    from .._serial.error_mapping import ErrorMapping
    from .._serial.transport import Transport
    from .async_line import AsyncLine
    from .base_client import Steps, Wait
    from .limits import Bounds
    from .report_filter import Kinds
    from .request import Run, Sent

_Result = TypeVar("_Result")
_Reply = TypeVar("_Reply", bound="Message")
_Second = TypeVar("_Second", bound="Message")
_Third = TypeVar("_Third", bound="Message")


class AsyncClient(BaseClient):
    """A client that sends messages over a transport, matches replies, and keeps reports.

    Safe to share between the tasks of one event loop: that in which it is first used. A call that
    is cancelled leaves the line usable for the others. Nothing waits for ever: every call ends with
    its result, or with an error, in a time that its arguments and `reply_timeout` bound. Better
    used in an `async with`; `close` waits until the last byte is out. A client that is dropped
    without `close` is closed with a ResourceWarning.

    `transport` is anything with the methods of Transport; it may block, since threads of its own
    read and write it. Without `background` there are none: the loop reads, when the transport says
    that something has come (`on_readable`), or else again and again; it must never block, and then
    `clock` may be of any kind, such as that of a loop in virtual time. The other arguments are
    those of the client for threads.
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
        super().__init__(
            transport,
            baud=baud,
            reply_timeout=reply_timeout,
            retries=retries,
            trace=trace,
            report_limit=report_limit,
            limits=limits,
            clock=clock,
            local_echo=local_echo,
            settle=settle,
        )
        self._background = background
        self._line = self._line_on(self._transport)
        self._loop: asyncio.AbstractEventLoop | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._watchers: set[asyncio.Future[None]] = set()
        # Whether the line is being reopened: there is one port, so one task does it for all.
        self._reopening = asyncio.Lock()
        self._ending: asyncio.Future[None] | None = None

    async def __aenter__(self) -> Self:
        self._check()
        self._bind()
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self.close()

    async def send(self, message: Message) -> Sent:
        """Send a command, as soon as the frames before it have left: no lag builds up unseen.

        Returns when it has been handed over; `delay` of the result is when it will be on the wire.
        The result is an AsyncMotion for a command that lasts, and a Run for one that is
        acknowledged. Raises LimitError for values outside the limits, and TransportError.
        """
        return self._sent(await self._finish(self._command(message)))

    async def request(self, message: Message, *, retries: int | None = None) -> Message:
        """Send a request and return the reply, which may hold less than was requested.

        Raises NoReplyError where none came in time, and TransportError.
        """
        return await self._finish(self._question(message, retries))

    async def reports(self, timeout: float | None = None) -> AsyncIterator[Message]:
        """Yield the reports as they come, those kept so far first; each goes to one iterator.

        The iterator ends when none has come for `timeout` seconds; without one, when this is
        closed. Reports that nobody takes are kept up to the limit; then the oldest are dropped, and
        counted in `counters.lost_reports`. Raises TransportError once the line is lost.
        """
        while (report := await self._finish(self._next_report(timeout))) is not None:
            yield report

    def on_report(self, callback: Callable[[Message], object]) -> Callable[[], None]:
        """Call `callback` with every report from now on; return a function that ends that.

        It is called in the event loop, in order, and must not block. Its exceptions are logged, and
        do not reach anybody else.
        """
        return self._add_callback(callback)

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
        return await self._finish(self._report(kind, timeout, fields))

    async def close(self) -> None:
        """Send what still waits to be sent, wait until the last byte is out, and close the line.

        Requests of other tasks end with ClosedError. May be called again, and by several tasks at
        once: each of them returns once the line is closed. If the event loop in which it was used
        has ended, it may be closed in another.
        """
        if self._ending is None:
            self._closing = True
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
            reopen = self._give_up_line(before)
            if reopen is None:
                return
            await self._line.call(partial(self._line.shut, 0.0))
            try:
                transport = await self._line.open(reopen)
            except TransportError as error:
                self._failure = error
                raise
            if self._closing:
                await self._line.call(transport.close)
                raise self._closed()
            self._line = self._line_on(transport)
            self._take_line(transport)
            self._loop = None
            self._bind()

    # ------------------------------------------------------------------ what the methods are of

    async def _move(self, message: Message, *, latest: bool) -> AsyncMotion:
        """Send a command that lasts."""
        if latest:
            return self._motion(self._submit_latest(message))
        return self._motion(await self._finish(self._command(message)))

    def _motion(self, request: Request) -> AsyncMotion:
        what = request, self._session.wire_time, self._clock, self._check
        return AsyncMotion(*what, finish=self._finish)

    async def _run(self, message: Message) -> Run:
        """Send a command that is acknowledged."""
        return await self._finish(self._acknowledged(message))

    async def _ask(self, message: Message, kind: type[_Reply]) -> _Reply:
        """Return the reply to a request, complete. Raises IncompleteReplyError."""
        return await self._finish(self._whole_reply(message, kind))

    async def _ask_in_parts(
        self, kind: type[Message], reply: type[_Reply], items: Iterable[Any]
    ) -> list[_Reply]:
        """Return the replies to a request that is too long for one. Raises IncompleteReplyError."""
        return await self._finish(self._replies(kind, reply, items))

    async def _exchanged(
        self, kind: type[Message], items: Iterable[Any]
    ) -> list[tuple[Message, Message]]:
        """Return the requests for a long list, each with its reply, complete or not."""
        return await self._finish(self._exchanges(kind, items))

    def _submit_latest(self, message: Message) -> Request:
        self._check()
        self._bind()
        request = self._session.submit(message, question=False, latest=True)
        # Whoever waits for it must learn that it has been sent or replaced.
        request.notify = self._wake
        self._advance()
        return request

    # ------------------------------------------------------------------ waiting

    async def _finish(self, steps: Steps[_Result]) -> _Result:
        """Take the steps of a call, one after the other, and wait between them."""
        self._bind()
        while True:
            try:
                wait = next(steps)
            except StopIteration as end:
                result: _Result = end.value
                return result
            await self._wait_for(wait)

    async def _wait_for(self, wait: Wait) -> None:
        """Wait until a request is done, or until something may have changed."""
        if not isinstance(wait, Request):
            await self._wait(wait)
            return
        done: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        wait.notify = partial(settle, done)
        self._advance()
        try:
            await done
        finally:
            self._session.cancel(wait)
            self._advance()
        if wait.sent is not None:
            # It counts as sent once the port has it.
            if self._failure is None:
                await self._line.handed_over()
            if self._failure is None and self._session.acknowledgements.unwritten:
                self._session.acknowledgements.written(self._clock(), wait.sent)
                self._advance()

    async def _wait(self, until: float | None) -> None:
        """Wait until a report has come or the line has failed, or until a time."""
        watcher: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._watchers.add(watcher)
        try:
            left = None if until is None else max(0.0, until - self._clock())
            await asyncio.wait([watcher], timeout=left)
        finally:
            self._watchers.discard(watcher)

    def _wake(self) -> None:
        for watcher in self._watchers:
            settle(watcher)

    # ------------------------------------------------------------------ the line

    def _line_on(self, transport: ErrorMapping) -> AsyncLine:
        kind = LineThreads if self._background else PolledLine
        session = self._session
        return kind(
            transport,
            self._clock,
            arrived=self._arrived,
            written=session.written,
            lost=self._lost,
        )

    def _bind(self) -> None:
        """Bind this to the running loop, and begin to read, on first use."""
        if self._closing or self._failure is not None:
            return
        loop = asyncio.get_running_loop()
        if self._loop is loop:
            return
        if self._loop is not None:
            raise RuntimeError("this client belongs to another event loop")
        self._loop = loop
        self._line.start(loop)

    def _advance(self) -> None:
        """Send what is due, see when to look again, and call back for reports."""
        now = self._clock()
        frames = self._session.outgoing(now)
        if frames:
            self._line.write(frames, self._session.unwritten)
        self._line.look_at(self._session.tick_at, self._session.resting_until(now))
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        send_at = self._session.send_at(now)
        if send_at is not None and self._loop is not None and self._failure is None:
            self._timer = self._loop.call_later(max(0.0, send_at - now), self._advance)
        while self._session.callback_queue:
            self._report_to_callbacks(self._session.callback_queue.popleft())

    def _arrived(self, line: AsyncLine, data: bytes, began: float, ended: float) -> None:
        if line is self._line and self._failure is None:
            reports = self._session.counters.reports
            self._session.receive(data, ended)
            # What had arrived before counts before any deadline does.
            self._session.tick(began)
            self._advance()
            if self._session.counters.reports != reports:
                self._wake()

    def _lost(self, line: AsyncLine, error: TransportError) -> None:
        if line is self._line:
            self._fail(error)

    def _fail(self, error: TransportError) -> None:
        super()._fail(error)
        self._line.let_go()

    # ------------------------------------------------------------------ how it ends

    async def _end(self) -> None:
        closed = self._closed()
        self._loop = asyncio.get_running_loop()
        self._session.refuse_questions(closed)
        self._advance()
        self._wake()
        try:
            await self._drain()
            longest = DRAIN_TIMEOUT if self._failure is None else 0.0
            await self._line.call(partial(self._line.shut, longest))
            await self._given_back()
        except asyncio.CancelledError:
            # The loop is about to end; the port is closed all the same.
            self._line.shut(0.0)
            raise
        finally:
            self._failure = self._failure or closed
            self._session.fail(closed)
            if self._timer is not None:
                self._timer.cancel()
            self._wake()
            self._line.let_go()
            self._trace.close()

    async def _drain(self) -> None:
        """Wait until all commands have been sent, and have had their time on the wire."""
        until = self._clock() + DRAIN_TIMEOUT
        while self._failure is None:
            # What is due goes first, even if the machine has paused for longer than that.
            self._advance()
            now, free_at = self._clock(), self._session.wire_time.free_at
            sent = self._session.idle and now >= free_at
            if sent or now >= max(until, free_at + DRAIN_TIMEOUT):
                return
            await asyncio.sleep(min(POLL_INTERVAL, max(0.001, free_at - now)))

    async def _given_back(self) -> None:
        """Wait until a reconnection in progress finds the client closed, and closes the port."""
        until = self._clock() + DRAIN_TIMEOUT
        while self._reopening.locked() and self._clock() < until:
            await asyncio.sleep(POLL_INTERVAL)

    def _abandon(self) -> None:
        self._line.stop()
