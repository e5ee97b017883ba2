"""A line that an event loop reads and writes by itself, without a thread, on whatever clock.

For transports that never block, such as a device in the same process, on virtual time.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ..line.link_errors import TransportError
from .async_line import AsyncLine
from .base_client import POLL_INTERVAL

if TYPE_CHECKING:
    import asyncio

    from .request import Request


class PolledLine(AsyncLine):
    """A line that is read when its transport says so, by `on_readable`, or else again and again."""

    def __init__(self, *line: Any, **callbacks: Any) -> None:
        super().__init__(*line, **callbacks)
        self._loop: asyncio.AbstractEventLoop | None = None
        self._timer: asyncio.TimerHandle | None = None

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Begin to carry bytes."""
        self._loop = loop
        if self.transport.on_readable is not None:
            self.transport.on_readable(self._wake)
        loop.call_soon(self._read)

    def write(self, frames: list[bytes], question: Request | None) -> None:
        """Hand frames over, the last of which is that of `question`, if there is one."""
        written, lost = self._written(), self._lost()
        try:
            for frame in frames:
                self.transport.write(frame)
        except TransportError as error:
            if lost is not None:
                lost(self, error)
        else:
            if question is not None and written is not None:
                written(question, self._clock())

    def look_at(self, tick_at: float | None, _resting_until: float, /) -> None:
        """Say `arrived` at that time at the latest; before the other one, nothing is complete."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        now = self._clock()
        times = [] if tick_at is None else [tick_at]
        if self.transport.on_readable is None:
            times.append(now + POLL_INTERVAL)
        if times and self._loop is not None and not self._loop.is_closed():
            self._timer = self._loop.call_later(max(0.0, min(times) - now), self._read)

    def stop(self) -> None:
        """Write what has been handed over, and nothing more."""
        self._loop = None
        if self._timer is not None:
            self._timer.cancel()

    def _wake(self) -> None:
        """Have the loop read soon, in whichever thread this is called."""
        if self._loop is not None and not self._loop.is_closed():
            self._loop.call_soon_threadsafe(self._read)

    def _read(self) -> None:
        arrived, lost, began = self._arrived(), self._lost(), self._clock()
        if self._loop is None or arrived is None or lost is None:
            return
        try:
            data = self.transport.read(0)
        except TransportError as error:
            lost(self, error)
            return
        if data:
            # There may be more, of which nobody will tell.
            self._loop.call_soon(self._read)
        arrived(self, data, began, self._clock())
