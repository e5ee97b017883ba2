"""The state that the checks share: what they examine, and what they have found so far."""

from __future__ import annotations

import math
import sys
import time
from functools import partial
from pathlib import Path

from ...line.error_mapping import ErrorMapping
from ...line.hid_devices import hid_devices_at_hand
from ...line.serial_port import open_port, serial_ports
from .heard import Heard
from .probe import Probe

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ...frame.message import Message
    from ...line.hid_devices import HidDevice
    from ...line.link_errors import TransportError
    from ...line.serial_port import SerialPortSeen
    from ...line.transport import Transport
    from ..program import Program
    from .probe import Entry
    from .trip import Trip

# What pseudo terminals are called: on Linux, and on macOS, whose serial ports have longer names.
_PSEUDO_TERMINALS = ("/dev/pts/", "/dev/ttys")


class Diagnosis:
    """One examination of one port, with what has been found so far.

    `program` is the command of the protocol that the device should speak. `port` may be None: the
    one that is plugged in is taken, if there is one. `opener` opens a port at a rate, `ports` and
    `hid_devices` return what is plugged in, and `clock` returns seconds; tests replace all of them.
    With `local_echo`, an echo is expected of what is sent. `question` is put to the device where
    another than the usual one is meant. `named_by` says what names the port, where no option does.
    """

    def __init__(
        self,
        program: Program,
        port: str | None,
        *,
        baud: float,
        local_echo: bool,
        reply_timeout: float = 0.25,
        question: Message | None = None,
        named_by: str = "",
        opener: Callable[[str, float], Transport] | None = None,
        ports: Callable[[], list[SerialPortSeen]] = serial_ports,
        hid_devices: Callable[[], list[HidDevice] | None] | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.program = program
        self.library = program.library
        self.port = port
        self.baud = baud
        self.reply_timeout = reply_timeout
        self.local_echo = local_echo
        self.question = question
        self.named_by = named_by
        self.ports = ports()
        at_hand = partial(hid_devices_at_hand, program.library.link)
        self.hid_devices = (hid_devices or at_hand)()
        self.log: list[Entry] = []
        # Why it could not be opened, and whether it was lost since.
        self.error: TransportError | None = None
        self.lost = False
        self.probe: Probe | None = None
        # What came unsolicited, and the round trips at the rate that proved right.
        self.unsolicited = Heard(self.library.codec, [])
        self.trips: list[Trip] = []
        # The numbers of those that are there behind the device.
        self.present: tuple[int, ...] = ()
        # What came at other rates, with each.
        self.strange: list[tuple[float, Heard]] = []
        self._clock = clock
        self._open = opener or self._opened

    def _opened(self, name: str, rate: float) -> Transport:
        return open_port(name, self.library.link, self.library.codec, baud=rate, exclusive=True)

    @property
    def stated(self) -> str:
        """The stated rate of the line, in words."""
        return "no rate" if math.isinf(self.baud) else f"{self.baud:g} baud"

    @property
    def device(self) -> str:
        """The name of the port that is examined; of a link, the name of what it leads to."""
        name = self.port or ""
        if sys.platform == "win32" or not name or "://" in name:
            return name
        return str(Path(name).resolve())

    @property
    def is_pseudo_terminal(self) -> bool:
        """Whether the port is a pseudo terminal, behind which there is a program."""
        return self.device.startswith(_PSEUDO_TERMINALS) and Path(self.device).is_char_device()

    @property
    def adapter(self) -> str:
        """The adapter that is plugged in, by VID:PID and product; empty if that is not known."""
        port = self.port or ""
        if port.lower().startswith("hid:"):
            return ", ".join(f"{each.ids} {each.product}" for each in self.hid_devices or [])
        found = (each for each in self.ports if each.name in (port, self.device))
        return next((f"{each.usb} {each.product}".strip() for each in found), "")

    def connect(self, baud: float | None = None) -> Probe:
        """Open the port, at a rate; close the one that was open before. Raises TransportError."""
        if self.port is None:
            raise AssertionError("no check asks for a port where none was found")
        self.close()
        rate = self.baud if baud is None else baud
        transport = ErrorMapping(self._open(self.port, rate), self.library.log)
        self.log.append((self._clock(), None, b"", f"opened, at {rate:g} baud"))
        self.probe = Probe(
            self.library,
            transport,
            baud=rate,
            reply_timeout=self.reply_timeout,
            clock=self._clock,
            log=self.log,
            local_echo=self.local_echo,
        )
        return self.probe

    def connected(self) -> Probe:
        """Return the open port."""
        return self.connect() if self.probe is None else self.probe

    def close(self) -> None:
        """Close the port."""
        if self.probe is not None:
            probe, self.probe = self.probe, None
            probe.close()
