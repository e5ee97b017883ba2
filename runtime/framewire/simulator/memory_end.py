"""The board in the same process: a transport that needs no port, no thread and no sleep."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from .clock import RealClock, VirtualClock

if TYPE_CHECKING:
    from collections.abc import Callable
    from threading import Condition

    from .clock import Clock
    from .line import Line


class MemoryEnd:
    """Both ends at once: a transport for a client, and the board's port.

    Reads and writes advance the board, since there is no thread that does.
    """

    name = "virtual board"

    def __init__(
        self,
        line: Line,
        clock: Clock,
        since: float,
        live: Callable[[], None],
        changed: Condition,
    ) -> None:
        # Those of the library whose client uses it.
        self._errors = line.board.errors
        self._line = line
        self._clock = clock
        self._since = since
        self._live = live
        self._changed = changed
        self._inbox = bytearray()
        self._plugged = False
        self._closed = False
        self._readable: Callable[[], object] | None = None
        # Only where somebody else moves the time on, and not a read.
        self.on_readable = self._call_when_readable if isinstance(clock, VirtualClock) else None

    # ---------------------------------------------------------------- the host's side

    def open(self) -> MemoryEnd:
        """Make it usable again after `close`. Raises PortNotFoundError while it is unplugged."""
        with self._changed:
            if not self._plugged:
                raise self._errors.PortNotFoundError(
                    self.name, "the board is unplugged", "plug_in() the board"
                )
            self._closed = False
            self._inbox.clear()
            return self

    def reopen(self) -> MemoryEnd:
        """Open it again, for a client's `reconnect`."""
        return self.open()

    def read(self, timeout: float) -> bytes:
        """Return what has arrived, waiting up to `timeout` seconds for the first byte; or b""."""
        with self._changed:
            end = self._host_time() + timeout
            while True:
                self._live()
                if self._inbox:
                    data = bytes(self._inbox)
                    self._inbox.clear()
                    return data
                self._check()
                left = end - self._host_time()
                if left <= 0:
                    return b""
                self._pass(left)

    def write(self, data: bytes) -> None:
        """Hand bytes to the line."""
        with self._changed:
            self._check()
            self._line.write(bytes(data), self._moment())
            self._live()
            self._changed.notify_all()

    def drain(self, timeout: float) -> None:
        """Return once the last byte has arrived at the board, or after `timeout` seconds."""
        with self._changed:
            end = self._host_time() + timeout
            while self._plugged and self._line.in_transit:
                left = end - self._host_time()
                if left <= 0:
                    return
                self._pass(left)
                self._live()

    def close(self) -> None:
        """End the host's use of it, until `open`. Any number of times."""
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def _call_when_readable(self, callback: Callable[[], object]) -> None:
        """Call `callback` from now on whenever a read would not come back empty."""
        with self._changed:
            self._readable = callback
            self._announce()

    def _announce(self) -> None:
        """Say that a read would not come back empty, or would fail."""
        self._changed.notify_all()
        if self._readable is not None:
            self._readable()

    def _check(self) -> None:
        if self._closed:
            raise self._errors.ClosedError(self.name, "it has been closed", "open it again")
        if not self._plugged:
            raise self._errors.DisconnectedError(
                self.name, "the board was unplugged", "plug_in() the board"
            )

    def _moment(self) -> float:
        return self._clock.now() - self._since

    def _host_time(self) -> float:
        """Return the time that waits are measured in: real time, unless reads move the clock."""
        follows = isinstance(self._clock, VirtualClock) and self._clock.follow_reads
        return self._clock.now() if follows else time.monotonic()

    def _pass(self, left: float) -> None:
        """Let time pass until the next event, and for no longer than `left`."""
        if isinstance(self._clock, VirtualClock) and self._clock.follow_reads:
            event = self._line.next_event
            end = self._clock.now() + left
            self._clock.move_to(end if event is None else min(end, self._since + event))
            return
        if isinstance(self._clock, RealClock):
            event = self._line.next_event
            left = left if event is None else min(left, max(0.0, event - self._moment()))
        self._changed.wait(left)

    # ---------------------------------------------------------------- the board's side

    @property
    def port(self) -> str:
        """A name for it; it opens nothing."""
        return self.name

    @property
    def host_baud(self) -> None:
        """None: in the same process there is no rate to set."""
        return None

    def plug_in(self) -> None:
        """Make it usable, unless it has been closed."""
        self._plugged = True

    def unplug(self) -> None:
        """Make the next read or write fail; what has arrived can still be read."""
        self._plugged = False
        self._announce()

    def deliver(self, data: bytes) -> None:
        """Put bytes where a read finds them."""
        if self._plugged:
            self._inbox += data
            self._announce()

    def wait(self, seconds: float | None, *, listening: bool) -> None:
        """Return at once: there is no thread that waits."""

    def receive(self) -> bytes:
        """Return b"": bytes that are written go to the line at once."""
        return b""

    def wake(self) -> None:
        """End the wait of a read."""
        with self._changed:
            self._changed.notify_all()
