"""The interface of a line to a device."""

from __future__ import annotations

from typing import Protocol


class Transport(Protocol):
    """A line for bytes both ways; raises OSError once it is lost."""

    def read(self, timeout: float) -> bytes:
        """Return what has arrived, waiting up to `timeout` seconds for the first byte."""
        ...

    def write(self, data: bytes) -> None:
        """Hand over all of `data`."""
        ...

    def close(self) -> None:
        """Close the line."""
        ...
