"""A client whose calls are awaited: the event loop holds the session, and a line carries bytes."""

from __future__ import annotations

import asyncio
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from ..line.transport import Transport
from .leaving import LeavingClient
from .line_threads import LineThreads, settle
from .motion import AsyncMotion
from .polled_line import PolledLine
from .request import Request

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..frame.message import Message
    from ..line.error_mapping import ErrorMapping
    from ..line.link_errors import TransportError
    from .async_line import AsyncLine
    from .base_client import Steps, Wait
    from .request import Run

_Result = TypeVar("_Result")
_Reply = TypeVar("_Reply", bound="Message")


class LoopClient(LeavingClient):
    """A client of one event loop: that in which it is first used."""

    def __init__(self, transport: Transport, *, background: bool, **settings: Any) -> None:
        super().__init__(transport, **settings)
        self._background = background
        self._line = self._line_on(self._transport)
        self._loop: asyncio.AbstractEventLoop | None = None
        self._timer: asyncio.TimerHandle | None = None
        self._watchers: set[asyncio.Future[None]] = set()

    # ------------------------------------------------------------------ what methods are made of

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
            # What is due goes now; and what ends by that ends the wait.
            self._advance()
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
            self._library,
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

    def _let_go(self) -> None:
        """Wake all who wait: the line is closed."""
        if self._timer is not None:
            self._timer.cancel()
        self._wake()
        self._line.let_go()

    def _abandon(self) -> None:
        self._line.stop()
