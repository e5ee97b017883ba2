"""What a line needs of the device at its end."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

    from .event_log import EventLog
    from .fault_injector import FaultInjector
    from .line_faults import LineFaults


class Report(Protocol):
    """What a device sends."""

    def encode(self) -> bytes:
        """Return its frame."""
        ...


class Rejects(Protocol):
    """How much input a device has rejected."""

    total: int


class VirtualDevice(Protocol):
    """A device that has been switched on at time 0, and lives through `advance_to`."""

    now: float
    event_log: EventLog
    heard: int

    @property
    def errors(self) -> ModuleType:
        """The module of its library with the errors of a link."""
        ...

    @property
    def baud(self) -> int:
        """The rate of its line."""
        ...

    @property
    def rejects(self) -> Rejects:
        """Its counts of rejected input."""
        ...

    @property
    def next_event(self) -> float | None:
        """When something happens by itself; None while nothing will."""

    def advance_to(self, moment: float) -> None:
        """Advance to a moment, through everything that happens by itself until then."""

    def hear(self, data: bytes) -> None:
        """Take in bytes that arrived now."""

    def take(self) -> Sequence[Report]:
        """Return what waits to be sent."""
        ...

    def reboot(self, seconds: float) -> None:
        """Switch it off and on: no input for `seconds`."""

    def injector(self, faults: LineFaults | None) -> FaultInjector:
        """Return what applies faults to its line; None for none."""
        ...
