"""A virtual device with its line and port: in the same process, or behind a pty or TCP port."""

from __future__ import annotations

from contextlib import contextmanager
from threading import Condition, Thread
from typing import TYPE_CHECKING, Literal, TypedDict

from .clock import RealClock, VirtualClock
from .line import Line
from .memory_end import MemoryEnd
from .pty_end import PtyEnd
from .tcp_end import LOOPBACK, TcpEnd

if TYPE_CHECKING:
    import os
    from collections.abc import Iterator
    from types import TracebackType

    from typing_extensions import Self

    from ..codec.rejects import Rejects
    from .clock import Clock
    from .event_log import EventLog
    from .fault_injector import Report
    from .line_faults import LineFaults
    from .port_end import PortEnd
    from .virtual_device import VirtualDevice

# A paced line takes no more than this ahead, and then makes the host wait, as a port does.
AHEAD = 4096
# A system wakes a thread this much later than requested; the rest of a wait is spent polling.
OVERSLEEP = 0.0001


class LineSettings(TypedDict, total=False):
    """What a VirtualLine can be given by name."""

    baud: float | None
    local_echo: bool | None
    clock: Clock | None
    faults: LineFaults | None
    link: str | os.PathLike[str] | None
    host: str
    tcp_port: int


class VirtualLine:
    """A virtual device, its line and its port; a context manager.

    `via` is "memory" (`port` is then a transport), "pty" (a name such as /dev/pts/3, or `link`) or
    "tcp" (a name such as socket://127.0.0.1:40123). With `baud`, bytes take the time both ways
    that they take on a wire; without it none, for quick tests, unlike the command, whose rate is
    that of the protocol. A host that sets another rate on the pty than `baud`, or than that of
    the protocol, receives garbage and sends garbage; "memory" and "tcp" have no rate to set.
    With `local_echo`, the adapter returns what the host sends, in front of what the device sends;
    without one, as the protocol says of its lines.
    With a VirtualClock, time stands still until `advance`.
    """

    def __init__(
        self,
        device: VirtualDevice,
        via: Literal["memory", "pty", "tcp"] = "memory",
        *,
        baud: float | None = None,
        local_echo: bool | None = None,
        clock: Clock | None = None,
        faults: LineFaults | None = None,
        link: str | os.PathLike[str] | None = None,
        host: str = LOOPBACK,
        tcp_port: int = 0,
    ) -> None:
        if baud is not None and not baud > 0:
            raise ValueError(f"baud is {baud}: it is above 0, or None for a line that is not paced")
        self.clock: Clock = RealClock() if clock is None else clock
        self._device = device
        self._since = self.clock.now()
        self._changed = Condition()
        if local_echo is None:
            local_echo = device.library.link.local_echo
        self._line = Line(device, baud=baud, local_echo=local_echo, faults=faults)
        self._paced = baud is not None
        self._transport: MemoryEnd | None = None
        self._end = self._make_end(via, link, host, tcp_port)
        self._thread: Thread | None = None
        self._closing = False
        if isinstance(self.clock, VirtualClock):
            self.clock.when_moved(self._nudge)
            self.clock.when_due(self._next_event)

    def _make_end(
        self, via: str, link: str | os.PathLike[str] | None, host: str, tcp_port: int
    ) -> PortEnd:
        if via == "pty":
            return PtyEnd(link, self._line.baud)
        if via == "tcp":
            return TcpEnd(host, tcp_port)
        if via != "memory":
            raise ValueError(f"via is {via!r}: it is 'memory', 'pty' or 'tcp'")
        self._transport = MemoryEnd(self._line, self.clock, self._since, self._live, self._changed)
        return self._transport

    def __enter__(self) -> Self:
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def start(self) -> None:
        """Plug the board in, and for a pty and TCP start the thread that serves the port."""
        try:
            self._end.plug_in()
        except OSError:
            self.close()
            raise
        if self._transport is None:
            self._thread = Thread(target=self._serve, name="virtual device", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Unplug it for good, and wait for its thread. Any number of times."""
        if self._closing:
            return
        self._closing = True
        self._end.wake()
        if self._thread is not None:
            self._thread.join()
        with self._changed:
            self._end.unplug()
            self._end.close()

    # ---------------------------------------------------------------- what a host opens

    @property
    def port(self) -> str:
        """The name of the port. In memory there is none to open: use `transport`."""
        return self._end.port

    @property
    def transport(self) -> MemoryEnd:
        """The transport to the board, of `via="memory"`. Raises ValueError otherwise."""
        if self._transport is None:
            raise ValueError(f"the board is at {self.port}: open that")
        return self._transport

    def open(self) -> MemoryEnd:
        """Return that transport, usable again if it was closed: what a client reconnects with."""
        return self.transport.open()

    # ---------------------------------------------------------------- what a test looks at

    @property
    def accepted(self) -> int:
        """How many messages the board understood."""
        self._nudge()
        return self._device.heard

    @property
    def rejects(self) -> Rejects:
        """The device's counts of rejected input, by reason."""
        self._nudge()
        return self._device.rejects

    @property
    def rejected(self) -> int:
        """How much input the device rejected."""
        return self.rejects.total

    @property
    def log(self) -> EventLog:
        """The events on the board, in lines."""
        self._nudge()
        return self._device.event_log

    # ---------------------------------------------------------------- what a test can do

    def advance(self, seconds: float) -> None:
        """Advance a VirtualClock. Raises TypeError with any other clock."""
        if not isinstance(self.clock, VirtualClock):
            raise TypeError("real time cannot be moved: give the board clock=VirtualClock()")
        self.clock.advance(seconds)

    def send_bytes(self, data: bytes) -> None:
        """Send bytes as they are: noise, or half a frame."""
        with self._changed:
            self._line.send(data, self._moment)
        self._nudge()

    def spurious_output(
        self, data: bytes | None, per_second: float = 960, *, ignore_input: bool = True
    ) -> None:
        """Send `data` again and again, and with `ignore_input` do nothing else; None ends it."""
        with self._changed:
            self._line.spurious_output(
                data or b"", per_second, self._moment, ignore_input=ignore_input
            )
        self._nudge()

    def reboot(self, seconds: float = 1.0) -> None:
        """Switch the board off and on: for so many seconds it receives and sends nothing."""
        with self._now():
            self._line.reboot(seconds)

    def report(self, report: Report) -> None:
        """Send a message of the device's own accord."""
        with self._now():
            self._device.send(report)

    def unplug(self) -> None:
        """Pull the cable out. The board lives on."""
        with self._changed:
            self._line.cut()
            self._end.unplug()

    def plug_in(self) -> None:
        """Put the cable back, after `unplug` or a hang-up."""
        with self._changed:
            self._line.mend()
            self._end.plug_in()
        self._nudge()

    @property
    def faults(self) -> LineFaults:
        """The faults that happen. Setting them, at any time, restarts from their seed."""
        return self._line.faults

    @faults.setter
    def faults(self, faults: LineFaults) -> None:
        with self._changed:
            self._line.faults = faults

    # ---------------------------------------------------------------- how it lives

    @property
    def _moment(self) -> float:
        return self.clock.now() - self._since

    def _live(self) -> None:
        """Advance to now, and deliver what has reached the host. Needs the lock."""
        whole = not self._line.hung_up
        self._line.host_baud = self._end.host_baud
        for data in self._line.read(self._moment):
            self._end.deliver(data)
        if whole and self._line.hung_up:
            self._end.unplug()

    def _next_event(self) -> float | None:
        """Return when something happens next, on the clock; None while nothing will."""
        event = None if self._closing else self._line.next_event
        return None if event is None else self._since + event

    @contextmanager
    def _now(self) -> Iterator[None]:
        """Advance to now, for something that happens to the device; then go on."""
        with self._changed:
            self._live()
            yield
        self._nudge()

    def _nudge(self) -> None:
        """Advance to now, and let the thread recalculate how long to wait."""
        with self._changed:
            self._live()
            self._end.wake()

    @property
    def _listening(self) -> bool:
        """Whether more of the host is taken in."""
        return not self._paced or self._line.in_transit < AHEAD

    def _serve(self) -> None:
        while not self._closing:
            with self._changed:
                data = self._end.receive() if self._listening else b""
                if data:
                    self._line.host_baud = self._end.host_baud
                    self._line.write(data, self._moment)
                self._live()
                event = self._line.next_event
                left = None if event is None else max(0.0, event - self._moment - OVERSLEEP)
                # As it is now: where this thread was late, nothing is on its way any more.
                listening = self._listening
            if isinstance(self.clock, VirtualClock):
                left = None  # whoever moves the clock wakes this thread
            self._end.wait(left, listening=listening)
