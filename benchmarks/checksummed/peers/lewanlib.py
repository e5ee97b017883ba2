"""lewanlib: a client for the servo bus, in degrees and seconds, on a port in memory."""

from __future__ import annotations

from typing import Any

from lewanlib.bus import ServoBus

from benchmarks.checksummed.peers.interface import Peer, Port, Work


class BusPort(Port):
    """A port that can be told to forget what has come."""

    def reset_input_buffer(self) -> None:
        """Forget what has come: nothing has, before it asks."""


class Lewanlib(Peer):
    """`move_time_write` and `move_time_wait_read` on a port in memory."""

    name = "lewanlib"
    distribution = "lewanlib"
    remark = "as lewansoul-lx16a; it works in degrees and seconds"

    def __init__(self) -> None:
        self._port = BusPort()
        self._bus = ServoBus(
            serial_conn=self._port, discard_echo=False, retry_count=0, on_exit_power_off=False
        )
        self.works = {
            "lxservo-encode": Work(self._move),
            "lxservo-reply": Work(self._prepared, _plain),
        }

    def _move(self, servo_id: int, position: int, time_ms: int) -> bytes:
        # It cuts off what is no whole step.
        self._bus.move_time_write(servo_id, (position + 0.5) * 0.24, time_ms / 1000)
        return self._port.written

    def _prepared(self, frame: bytes) -> Any:
        self._port.waiting = frame
        return self._bus.move_time_wait_read(1)


def _plain(values: tuple[float, float]) -> tuple[int, int, int]:
    degrees, seconds = values
    return 1, round(degrees / 0.24), round(1000 * seconds)


def peers() -> list[Peer]:
    """Return the peers of lewanlib."""
    return [Lewanlib()]
