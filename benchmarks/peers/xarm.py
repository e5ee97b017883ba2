"""xarm: a client for this very controller, without a codec that could be called by itself.

Its verbs write to a port and read from it.
Behind them lies a port in memory here, so that what is timed is xarm's own work;
a decode therefore includes the request that its public verb sends first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import xarm

from benchmarks import floor
from benchmarks.peers.interface import Peer

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


class _Port:
    """A serial port that keeps what is written, and answers with a frame put there before."""

    def __init__(self) -> None:
        self.written = bytearray()
        self.answer = b""
        self._offset = 0

    def flush(self) -> None:
        pass

    def write(self, data: Iterable[int]) -> None:
        self.written += bytes(data)

    def read(self, size: int) -> bytes:
        start = self._offset
        # It asks for two bytes more than a frame has; a port would let it wait for them.
        end = min(start + size, len(self.answer))
        self._offset = end % len(self.answer)
        return self.answer[start:end]


class Xarm(Peer):
    """`setPosition`, `getPosition` and `getBatteryVoltage` on a port in memory."""

    name = "xarm"
    distribution = "xarm"
    import_statement = "import xarm"

    def __init__(self) -> None:
        super().__init__()
        self._port = _Port()
        # The constructor opens a real port; there is no other way to hand one in.
        self._controller = xarm.Controller.__new__(xarm.Controller)
        self._controller._device = self._port
        self._controller._is_serial = True
        self._controller.debug = False
        self._servos = [xarm.Servo(servo_id) for servo_id in range(1, 7)]
        self.parsers = {floor.BATTERY: self._battery, floor.POSITIONS: self._positions}
        self.lacks = {"stream": "has no stream decoder: it reads one awaited reply"}

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Return the bytes that `setPosition` writes."""
        self._port.written.clear()
        self._controller.setPosition(targets, duration=time_ms)
        return bytes(self._port.written)

    def _positions(self, frame: bytes) -> Any:
        self._port.answer = frame
        self._controller.getPosition(self._servos)
        return self._servos

    def _battery(self, frame: bytes) -> Any:
        self._port.answer = frame
        return self._controller.getBatteryVoltage()

    def plain(self, command: int, message: Any) -> object:
        """Return the servos, read by attribute; volts in millivolts."""
        if command == floor.POSITIONS:
            return tuple((servo.servo_id, servo.position) for servo in message)
        return round(message * 1000)


def peers() -> list[Peer]:
    """Return the peers of xarm."""
    return [Xarm()]
