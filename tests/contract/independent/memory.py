"""A second opinion, written apart: a memory, whose late answers overtake each other.

Written from the layout in `specs/bad/base/memory.yaml` alone, by hand. Nothing in a reply says
which request it answers, but how many bytes it holds. Each byte of it is the number of the
question, so that a stale one shows.
"""

import struct
from collections.abc import Mapping

HEADER = b"\xaa\x55"
READ = 1
BYTE = 10 / 9600


class MemoryPort:
    """A transport in virtual time, with the memory behind it; some replies, by number, are late."""

    name = "independent memory"

    def __init__(self, late: Mapping[int, float]) -> None:
        self.now = 0.0
        self.questions = 0
        self._late = late
        self._coming: list[tuple[float, int, bytes]] = []

    def clock(self) -> float:
        """Return the time."""
        return self.now

    def write(self, data: bytes) -> None:
        """Answer a question, once it and its reply have had their time on the wire."""
        header, size, command, _start, count = struct.unpack("<2sBBHB", data)
        assert (header, size, command) == (HEADER, 4, READ)
        self.questions += 1
        reply = HEADER + bytes([count + 1, READ]) + bytes([self.questions]) * count
        there = self.now + (len(data) + len(reply)) * BYTE
        at = there + self._late.get(self.questions, 0.0)
        self._coming.append((at, self.questions, reply))

    def read(self, timeout: float) -> bytes:
        """Return the next reply, if it comes in time."""
        until = self.now + max(timeout, 1e-6)
        due = min(self._coming, default=(float("inf"), 0, b""))
        if due[0] > until:
            self.now = until
            return b""
        self._coming.remove(due)
        self.now = max(self.now, due[0])
        return due[2]

    def drain(self, _timeout: float) -> None:
        """Let no time pass: nothing is held back."""

    def close(self) -> None:
        """End its use."""
