"""A device at the end of a line: what each virtual device does, whatever its protocol."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, ClassVar

from ..frame.bytes_like import format_hex
from .event_log import EventLog
from .fault_injector import FaultInjector
from .line_faults import LineFaults

if TYPE_CHECKING:
    from types import ModuleType

    from ..client.device import Device
    from ..client.library import Library
    from ..codec.noise import Noise
    from ..frame.message import Message
else:
    Device = object  # that of a library stands behind this one

# How many bytes of rejected input the log shows.
_SHOWN = 16


class VirtualDevice(Device):
    """A device that has been switched on at time 0, and lives through `advance_to`.

    It stands in front of the Device of a library: `class Board(VirtualDevice, Device)`. Its
    `library` says what line it is at and what answers what, its handlers what it does with each
    message, and its `name` who it is in the log of events.
    """

    library: ClassVar[Library]
    name: ClassVar[str] = "device"

    def __init__(self) -> None:
        super().__init__()
        self.now = 0.0
        self.heard = 0
        self.event_log = EventLog(f"{self.library.package}_simulator")
        self._blackout_until = 0.0

    @property
    def errors(self) -> ModuleType:
        """The module of its library, which has the errors of a line."""
        return sys.modules[self.library.package]

    @property
    def next_event(self) -> float | None:
        """When something happens by itself that a host would see; None while nothing will."""
        return None

    def advance_to(self, moment: float) -> None:
        """Advance to a moment, through everything that happens by itself until then."""
        self.now = max(self.now, moment)

    def hear(self, data: bytes) -> None:
        """Take in bytes that arrived now, unless it is still starting."""
        if self.now >= self._blackout_until:
            self.accept(data)

    def accepted(self, message: Message) -> None:
        """Count a message, and log it."""
        self.heard += 1
        self.log_message(message)

    def rejected(self, noise: Noise) -> None:
        """Log what is no frame."""
        dots = " ..." if len(noise.data) > _SHOWN else ""
        self.log_noise(noise.reason.value, format_hex(noise.data[:_SHOWN]) + dots)

    def log_message(self, message: Message) -> None:
        """Log a message."""
        self.log(self.name, repr(message))

    def log_noise(self, reason: str, shown: str) -> None:
        """Log what was rejected, why, and how its bytes begin."""
        self.log(self.name, f"{reason}: {shown}")

    def reboot(self, seconds: float) -> None:
        """Switch it off and on: no input for `seconds`."""
        self.log(self.name, f"restarts, for {seconds:g} s")
        self.restart()
        self._blackout_until = self.now + seconds

    def injector(self, faults: LineFaults | None) -> FaultInjector:
        """Return what applies faults to its line; None for none."""
        return FaultInjector(faults or LineFaults(), self.library)

    def log(self, who: str, what: str) -> None:
        """Log an event of now."""
        self.event_log.add(self.now, who, what)
