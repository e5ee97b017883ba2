"""lewansoul-lx16a: a client for the servo bus, without a codec that could be called by itself.

Its verbs write to a port and read from it. Behind them lies a port in memory here, so that what is
timed is its own work; a decode therefore includes the question that its public verb sends first.
"""

from __future__ import annotations

from typing import Any

import lewansoul_lx16a

from benchmarks.checksummed.peers.interface import Peer, Port, Work


class LewansoulLx16a(Peer):
    """`move` and `get_prepared_move` on a port in memory."""

    name = "lewansoul-lx16a"
    distribution = "lewansoul-lx16a"
    remark = "it reads one awaited reply, so it decodes no other frame, and no stream"

    def __init__(self) -> None:
        self._port = Port()
        self._servos = lewansoul_lx16a.ServoController(self._port)
        self.works = {
            "lxservo-encode": Work(self._move),
            "lxservo-reply": Work(self._prepared, lambda values: (1, *values)),
        }

    def _move(self, servo_id: int, position: int, time_ms: int) -> bytes:
        self._servos.move(servo_id, position, time_ms)
        return self._port.written

    def _prepared(self, frame: bytes) -> Any:
        self._port.waiting = frame
        return self._servos.get_prepared_move(1)


def peers() -> list[Peer]:
    """Return the peers of lewansoul-lx16a."""
    return [LewansoulLx16a()]
