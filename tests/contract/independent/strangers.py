"""Written apart: devices that are not the board, on the same port; most of them print text.

They are written with the standard library alone, and share no code with what they are shown to.
"""

import heapq
import math
from collections.abc import Callable
from itertools import count
from typing import NamedTuple

from tests.contract.independent.levels import BITS, received

GPS = (
    b"$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n"
    b"$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\r\n"
)
MODEM = b"\r\nERROR\r\n"
SKETCH = b"distance = 17 cm\r\n"
BANNER = (
    b"ets Jun  8 2016 00:22:57\r\n\r\nrst:0x1 (POWERON_RESET),boot:0x13 (SPI_FAST_FLASH_BOOT)\r\n"
    b"load:0x3fff0018,len:4\r\nentry 0x400806a8\r\n"
)


class Print(NamedTuple):
    """What is printed at a time, and again every so many seconds."""

    at: float
    data: bytes
    every: float = math.inf


class Stranger:
    """A device that prints at its times, and says `answer` after whatever it is sent.

    Its line has a rate; what a port of another rate reads is what the levels say to that, and so of
    what it sends on an `inverted` line. It begins anew when the port is opened, if it `resets`, as
    boards do that are wired to DTR.
    """

    def __init__(
        self,
        *prints: Print,
        answer: Callable[[bytes], bytes] = lambda _: b"",
        rate: float = 9600.0,
        inverted: bool = False,
        resets: bool = False,
    ) -> None:
        self._prints = prints
        self._answer = answer
        self._rate = rate
        self._inverted = inverted
        self._resets = resets
        self._due: list[tuple[float, int, bytes, float]] = []
        self._count = count()
        self._read_at = rate
        self.begin(0.0)

    def begin(self, now: float) -> None:
        """Print all from its beginning on."""
        for each in self._prints:
            self._put(now + each.at, each.data, each.every)

    def opened(self, rate: float, now: float) -> "Stranger":
        """Return itself, read at a rate from now on."""
        self._read_at = rate
        # What came while nobody read is lost.
        self.read(now)
        if self._resets:
            self._due.clear()
            self.begin(now)
        return self

    def write(self, data: bytes, now: float) -> None:
        """Take bytes from the host, which it understands only at its own rate."""
        heard = received(data, sent_at=self._read_at, read_at=self._rate)
        reply = self._answer(heard)
        if reply:
            self._put(now + len(data) * BITS / self._read_at, reply, math.inf)

    def read(self, now: float) -> bytes:
        """Return what the port has read by now."""
        found = b""
        while self._due and self._due[0][0] <= now:
            at, _, data, every = heapq.heappop(self._due)
            found += received(
                data, sent_at=self._rate, read_at=self._read_at, inverted=self._inverted
            )
            if every < math.inf:
                self._put(max(at + every, now), data, every)
        return found

    @property
    def next_event(self) -> float:
        """When something comes next; infinity if nothing will."""
        return self._due[0][0] if self._due else math.inf

    @property
    def in_transit(self) -> int:
        """How many bytes are on their way to it: it takes all at once."""
        return 0

    def _put(self, at: float, data: bytes, every: float) -> None:
        heapq.heappush(self._due, (at, next(self._count), data, every))
