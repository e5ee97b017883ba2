"""Two threads that carry bytes between a transport, which may block, and an event loop."""

from __future__ import annotations

import asyncio
import threading
import time
from queue import SimpleQueue
from typing import TYPE_CHECKING, TypeVar

from ..line.link_errors import TransportError
from .async_line import AsyncLine
from .base_client import DRAIN_TIMEOUT, POLL_INTERVAL
from .request import Request

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, Protocol, TypeAlias

    # Frames to write, a future to resolve once those before it are written, and None for the end.
    _Outbox: TypeAlias = SimpleQueue[bytes | Request | asyncio.Future[None] | None]

    class _Closable(Protocol):
        def close(self) -> None: ...


_Result = TypeVar("_Result")
_Opened = TypeVar("_Opened", bound="_Closable")
# While the loop is busy, work that is due stays due: the reading thread must not spin meanwhile.
_SHORTEST_READ = 0.002


class LineThreads(AsyncLine):
    """A line that is read by one thread and written by another, once it is started.

    They hold the client only while they are at work, so that it can end when nobody else does.
    """

    def __init__(self, *line: Any, **callbacks: Any) -> None:
        super().__init__(*line, **callbacks)
        self._outbox: _Outbox = SimpleQueue()
        self._threads: list[threading.Thread] = []
        self._closed = False
        # When the reading thread should report, at the latest, that time has passed and nothing
        # come.
        self._tick_at: float | None = None
        # Until when nothing that is arriving can be complete.
        self._resting_until = float("-inf")
        # Futures that wait until the frames before them have been handed over.
        self._handing: set[asyncio.Future[None]] = set()

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Begin to carry bytes."""
        self._threads = [
            threading.Thread(target=run, args=(loop,), daemon=True)
            for run in (self._run_reader, self._run_writer)
        ]
        for thread in self._threads:
            thread.name = f"{self._library.package} on {self.transport.name}"
            thread.start()

    def write(self, frames: list[bytes], question: Request | None) -> None:
        """Hand frames over, the last of which is that of `question`, if there is one."""
        for frame in frames:
            self._outbox.put(frame)
        if question is not None:
            self._outbox.put(question)

    def look_at(self, tick_at: float | None, resting_until: float, /) -> None:
        """Say `arrived` at that time at the latest; before the other one, nothing is complete."""
        self._tick_at = tick_at
        self._resting_until = resting_until

    async def handed_over(self) -> None:
        """Wait until the transport has taken all frames so far, or the line is let go."""
        taken: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._handing.add(taken)
        self._outbox.put(taken)
        try:
            await taken
        finally:
            self._handing.discard(taken)

    def let_go(self) -> None:
        """Have nobody wait any more until frames are handed over: the line has failed."""
        for taken in self._handing:
            settle(taken)

    async def call(self, blocking: Callable[[], _Result]) -> _Result:
        """Call what may block for as long as the transport does."""
        return await asyncio.get_running_loop().run_in_executor(None, blocking)

    async def open(self, opener: Callable[[], _Opened]) -> _Opened:
        """Open a line anew; one that opens when nobody waits any more is closed again."""
        return await opened(opener)

    def stop(self) -> None:
        """Write what has been handed over, and nothing more."""
        self._outbox.put(None)

    def shut(self, drain: float) -> None:
        """Write what is left, wait up to `drain` seconds for the wire, and close the transport."""
        self.stop()
        for thread in self._threads[1:]:
            thread.join(DRAIN_TIMEOUT)
        super().shut(drain)
        self._closed = True
        for thread in self._threads[:1]:
            thread.join(DRAIN_TIMEOUT)

    # ------------------------------------------------------------------ in the threads

    def _run_reader(self, loop: asyncio.AbstractEventLoop) -> None:
        # A transport that is closed need not say so, as long as its reads end.
        while not self._closed and self._arrived() is not None and self._read(loop):
            pass

    def _read(self, loop: asyncio.AbstractEventLoop) -> bool:
        """Carry what arrives to the loop; False once the line, the loop or the client has ended."""
        # Single bytes are not worth waking up for, each by itself.
        rest = self._resting_until - self._clock()
        if rest > 0:
            time.sleep(min(rest, POLL_INTERVAL))
        began = self._clock()
        tick_at = self._tick_at
        left = POLL_INTERVAL if tick_at is None else tick_at - began
        try:
            data = self.transport.read(min(POLL_INTERVAL, max(_SHORTEST_READ, left)))
            ended = self._clock()
        except TransportError as error:
            _post(loop, self._lost(), self, error)
            return False
        if not data and tick_at is None:
            return True
        return _post(loop, self._arrived(), self, data, began, ended)

    def _run_writer(self, loop: asyncio.AbstractEventLoop) -> None:
        while (item := self._outbox.get()) is not None:
            try:
                if isinstance(item, bytes):
                    self.transport.write(item)
                elif isinstance(item, Request):
                    _post(loop, self._written(), item, self._clock())
                else:
                    _post(loop, settle, item)
            except TransportError as error:
                _post(loop, self._lost(), self, error)
                return


async def opened(opener: Callable[[], _Opened]) -> _Opened:
    """Open a line outside of the loop; one that opens when nobody waits any more is closed."""
    opening = asyncio.get_running_loop().run_in_executor(None, opener)
    try:
        return await asyncio.shield(opening)
    except asyncio.CancelledError:
        opening.add_done_callback(_close_late)
        raise


def settle(future: asyncio.Future[None]) -> None:
    """End a wait, unless it has ended."""
    # In a loop that has ended, nobody waits any more.
    if not future.done() and not future.get_loop().is_closed():
        future.set_result(None)


def _close_late(opening: asyncio.Future[Any]) -> None:
    if not opening.cancelled() and opening.exception() is None:
        opening.result().close()


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
