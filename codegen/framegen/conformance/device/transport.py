"""What a line to a device has to offer."""

from __future__ import annotations

from typing import Protocol


class Transport(Protocol):
    """Carries bytes both ways; raises OSError where it cannot any more."""

    def read(self, timeout: float) -> bytes:
        """What has arrived, waiting up to `timeout` seconds for the first byte of it."""
        ...

    def write(self, data: bytes) -> None:
        """Hand over all of `data`."""
        ...

    def close(self) -> None:
        """Give the line back."""
        ...
