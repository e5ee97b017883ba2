"""A line whose other end is a function, from each frame to what comes back for it, in no time."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


class ScriptedLine:
    """A transport in virtual time; what is written is kept in `written`, a frame each."""

    name = "scripted line"

    def __init__(self, answer: Callable[[bytes], bytes]) -> None:
        self.now = 0.0
        self.written: list[bytes] = []
        self.answer = answer
        self._arrived = b""
        self.unasked = False

    def clock(self) -> float:
        return self.now

    def read(self, timeout: float) -> bytes:
        data, self._arrived = self._arrived, b""
        self.now += 0.0 if data else max(timeout, 1e-6)
        return data

    def write(self, data: bytes) -> None:
        self.written.append(data)
        self._arrived += self.answer(data)

    def come(self, data: bytes) -> None:
        """Let bytes arrive that nobody asked for."""
        self.unasked = True
        self._arrived += data

    def drain(self, _timeout: float) -> None:
        pass

    def close(self) -> None:
        pass
