"""The devices on a line that several share, as a client sees them: one of them, or all."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import Any


class OneDevice:
    """One device on the line, by its address. A library's own has the methods that are for it."""

    __slots__ = ("_bus", "address")

    def __init__(self, bus: Any, address: int) -> None:
        # The client: each library's own says of which class it is.
        self._bus = bus
        self.address = address

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.address} of {self._bus!r}>"


class AllDevices(OneDevice):
    """All devices on the line at once, by an address that many listen to."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of {self._bus!r}>"
