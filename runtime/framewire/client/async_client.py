"""The client for asyncio: its calls are awaited, and the loop holds the conversation."""

from __future__ import annotations

import asyncio
import sys
import time
from collections.abc import AsyncIterator, Callable, Iterable
from functools import partial
from os import PathLike
from types import TracebackType
from typing import TYPE_CHECKING, TypeVar, overload

from ..frame.message import Message
from ..line.link_errors import ClosedError, TransportError
from ..line.transport import Transport
from .awaited import Awaited
from .base_client import DRAIN_TIMEOUT, POLL_INTERVAL, REPLY_TIMEOUT, REPORT_LIMIT
from .limits import Allowed
from .loop_client import LoopClient
from .report_filter import Kinds
from .request import Sent

if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from ..frame.typing_later import typing

_Reply = TypeVar("_Reply", bound="Message")
_Second = TypeVar("_Second", bound="Message")
_Third = TypeVar("_Third", bound="Message")


class AsyncClient(LoopClient):
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
        baud: float | None = None,
        reply_timeout: float = REPLY_TIMEOUT,
        retries: int = 0,
        trace: str | PathLike[str] | None = None,
        report_limit: int = REPORT_LIMIT,
        limits: Allowed | str = "usual",
        ids: Iterable[int] = (),
        on_exit: str | None = None,
        background: bool = True,
        clock: Callable[[], float] = time.monotonic,
        local_echo: bool | None = None,
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
            ids=ids,
            on_exit=on_exit,
            background=background,
            clock=clock,
            local_echo=local_echo,
            settle=settle,
        )
        # Whether the line is being reopened: there is one port, so one task does it for all.
        self._reopening = asyncio.Lock()
        self._ending: asyncio.Future[None] | None = None

    @classmethod
    def at_port(
        cls,
        port: str,
        *,
        baud: float | None = None,
        exclusive: bool = True,
        reply_timeout: float = REPLY_TIMEOUT,
        retries: int = 0,
        trace: str | PathLike[str] | None = None,
        report_limit: int = REPORT_LIMIT,
        limits: Allowed | str = "usual",
        ids: Iterable[int] = (),
        on_exit: str | None = None,
        local_echo: bool | None = None,
        settle: float | None = None,
    ) -> Awaited[typing.Self]:
        """Open the port of a device, to be used in an `async with`.

        It may also be awaited, and the client closed by hand. The arguments and the errors are
        those of the client for threads; the errors come when it is entered or awaited.
        """
        opener = partial(cls._library.open_transport, port, baud=baud, exclusive=exclusive)
        make = partial(
            cls,
            baud=baud,
            reply_timeout=reply_timeout,
            retries=retries,
            trace=trace,
            report_limit=report_limit,
            limits=limits,
            ids=ids,
            on_exit=on_exit,
            local_echo=local_echo,
            settle=settle,
        )
        return Awaited(opener, make)

    async def __aenter__(self) -> typing.Self:
        self._check()
        self._bind()
        return self

    async def __aexit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        await self._close(error)

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

        What `on_exit` asks for comes after all that is sent, within two seconds; if this is
        cancelled, it is given up at once. Raises NotHeldError, once the line is closed, for those
        that were not reached; while another exception is being handled, that is logged instead.
        """
        await self._close(sys.exc_info()[1])

    async def _close(self, under_way: BaseException | None) -> None:
        if self._ending is None:
            if self._loop is None and self._to_leave():
                self._bind()
            self._closing = True
            self._ending = asyncio.ensure_future(self._end())
        # It is closed as well if the loop ended in the middle of closing it.
        if not self._ending.cancelled():
            try:
                # Once begun, it is completed: half a frame on the line would spoil the next one.
                await asyncio.shield(self._ending)
            except asyncio.CancelledError as error:
                self._hurry()
                self._tell_left(error)
                raise
        self._tell_left(under_way)

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

    # ------------------------------------------------------------------ how it ends

    async def _end(self) -> None:
        closed = self._closed()
        self._loop = asyncio.get_running_loop()
        self._session.refuse_questions(closed)
        self._advance()
        self._wake()
        try:
            await self._drain()
            for wait in self._leave():
                await self._wait_for(wait)
            await self._drain()
            longest = DRAIN_TIMEOUT if self._failure is None else 0.0
            await self._line.call(partial(self._line.shut, longest))
            await self._given_back()
            if self._failure is not None and not isinstance(self._failure, ClosedError):
                # Nothing tells which frames a line has carried that was lost meanwhile.
                self._lose(self._failure, self._leaving)
        except BaseException:
            # The loop is about to end, as a rule; the port is closed all the same.
            self._line.shut(0.0)
            raise
        finally:
            self._failure = self._failure or closed
            self._session.fail(closed)
            self._let_go()
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
