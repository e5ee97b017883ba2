"""A line in virtual time: a read moves the clock on, and nothing sleeps.

Whatever only answers on a line is made of this one: by a function from a frame to bytes, by a
Device, or by messages of a board (tests/lines/virtual_line.py). What is a second opinion shares
nothing with it: tests/contract/independent, tests/lines/servo_bus.py.
"""

import asyncio
import heapq
import math
from collections.abc import Callable, Iterable
from typing import Any

from busservo_simulator import VirtualClock
from framewire.simulator.virtual_loop import VirtualLoop

from tests.handed import handed_by

# Pieces of bytes, each with the seconds until it arrives.
Pieces = list[tuple[float, bytes]]


class TimedLine:
    """A transport whose other end answers each write: bytes, each after a delay.

    For threads and for asyncio: a loop that runs on its `timer` is called as soon as bytes are
    there, and then no read moves the clock on. What was written is kept in `written`. Bytes arrive
    in the order in which they were sent, whatever their delays, unless `in_order` says otherwise.
    """

    name = "line"

    def __init__(
        self,
        answer: Callable[[bytes], Iterable[tuple[float, bytes]]] = lambda _: (),
        timer: VirtualClock | None = None,
        *,
        in_order: bool = True,
    ) -> None:
        self.in_order = in_order
        self.timer = timer or _clock_of_the_loop()
        self.written: list[bytes] = []
        self.closed = False
        self._answer = answer
        self._arriving: list[tuple[float, int, bytes]] = []
        self._number = 0
        self._last = -math.inf
        self._readable: Callable[[], object] | None = None

    @property
    def now(self) -> float:
        """The time, which may also be set: the process stands still until then."""
        return self.timer.now()

    @now.setter
    def now(self, moment: float) -> None:
        self.timer.move_to(moment)

    def clock(self) -> float:
        return self.timer.now()

    def say(self, data: Any, delay: float = 0.0) -> None:
        """Let bytes or a message arrive, `delay` seconds from now."""
        octets = data if isinstance(data, bytes) else data.encode()
        at = self.now + delay
        if self.in_order:
            at = self._last = max(at, self._last)
        self._number += 1
        heapq.heappush(self._arriving, (at, self._number, octets))
        self._tell()

    # ------------------------------------------------------------------ a transport

    def read(self, timeout: float) -> bytes:
        if self._readable is None:
            # However short the wait, time goes on: or else a client that polls would stand still.
            until = self.now + max(timeout, 1e-6)
            self.now = min(until, self._arriving[0][0] if self._arriving else until)
        return self._take()

    def write(self, data: bytes) -> None:
        self.written.append(data)
        for delay, answer in self._answer(data):
            self.say(answer, delay)

    def drain(self, _timeout: float) -> None:
        pass

    def close(self) -> None:
        self.closed = True

    def on_readable(self, callback: Callable[[], object]) -> None:
        """Call back once something has arrived, on the time of a loop."""
        if self._readable is None:
            self.timer.when_due(self._next_arrival)
            self.timer.when_moved(self._tell)
        self._readable = callback

    def _take(self) -> bytes:
        data = b""
        while self._is_there():
            data += heapq.heappop(self._arriving)[2]
        return data

    def _next_arrival(self) -> float | None:
        """Return when more arrives; what is there and nobody reads is no event."""
        return min((at for at, *_ in self._arriving if at > self.now), default=None)

    def _is_there(self) -> bool:
        return bool(self._arriving) and self._arriving[0][0] <= self.now

    def _tell(self) -> None:
        if self._readable is not None and self._is_there():
            self._readable()


class ScriptedLine(TimedLine):
    """A line whose other end is a function, from each frame to what comes for it, in no time."""

    name = "scripted line"

    def __init__(self, answer: Callable[[bytes], bytes]) -> None:
        super().__init__(lambda data: [(0.0, self.answer(data))])
        self.answer = answer
        self.unasked = False

    def come(self, data: bytes) -> None:
        """Let bytes arrive that nobody asked for."""
        self.unasked = True
        self.say(data)


class DeviceLine(TimedLine):
    """A line to the Device of any library: what that sends waits here to be read.

    With `echo`, what is written comes back as well.
    """

    # Nobody is called back for what the device sends by itself.
    on_readable = None  # type: ignore[assignment]

    def __init__(self, device: Any, *, echo: bool = False) -> None:
        super().__init__(lambda data: [(0.0, data)] if echo else [])
        self.device = device

    def read(self, timeout: float) -> bytes:
        for message in self.device.take():
            self.say(message)
        return super().read(timeout)

    def write(self, data: bytes) -> None:
        super().write(data)
        self.device.accept(data)


def client_of(device: Any, kind: type | None = None, **given: Any) -> Any:
    """Return a client of the device's library, by default for threads; nothing in it sleeps."""
    package = next(
        each.__module__.partition(".")[0]
        for each in type(device).__mro__
        if each.__name__ == "Device"
    )
    return client_on(DeviceLine(device), kind or handed_by(package).client, **given)


def client_on(line: Any, kind: type, **given: Any) -> Any:
    """Return a client of that kind on the time of its line, at which it need not wait first."""
    return kind(line, **{"background": False, "clock": line.clock, "settle": 0, **given})


def _clock_of_the_loop() -> VirtualClock:
    """Return the clock of the loop that runs, or a new one where none does."""
    try:
        loop = asyncio.get_running_loop()
    except RuntimeError:
        return VirtualClock()
    return loop.clock if isinstance(loop, VirtualLoop) else VirtualClock()
