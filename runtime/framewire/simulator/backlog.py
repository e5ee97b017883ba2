"""Output that a host has not read yet, as far as a port keeps it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

MOST = 65536


class Backlog:
    """Bytes that a non-blocking port could not take at once."""

    def __init__(self) -> None:
        self.data = b""
        self.lost = 0

    def send(self, data: bytes, write: Callable[[bytes], int]) -> None:
        """Write as much as `write` takes; beyond what can be kept, the newest bytes are lost."""
        self.data += data
        while self.data:
            try:
                written = write(self.data)
            except BlockingIOError:
                break
            self.data = self.data[written:]
        if len(self.data) > MOST:
            self.lost += len(self.data) - MOST
            self.data = self.data[:MOST]
