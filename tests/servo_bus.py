"""Servos on a bus for the examples of our pages: at once where they are told to be."""

from __future__ import annotations

import contextlib
import socket
import threading
from typing import TYPE_CHECKING

from lxservo import (
    Move,
    MovePrepare,
    MoveStart,
    Offset,
    OffsetRead,
    Position,
    PositionRead,
    ServoId,
    ServoIdRead,
    ServoIdWrite,
    Temperature,
    TemperatureRead,
    Voltage,
    VoltageRead,
)
from lxservo.device import Device

if TYPE_CHECKING:
    from typing_extensions import Self

ALL = Move.SERVO_ID_ALL


class Servos(Device):
    """Several servos, by number."""

    def __init__(self, *numbers: int) -> None:
        super().__init__(*numbers)
        self.positions = dict.fromkeys(numbers, 500)
        self._prepared: dict[int, int] = {}

    def _meant(self, servo_id: int) -> list[int]:
        return [*self.positions] if servo_id == ALL else [servo_id]

    def on_move(self, message: Move) -> None:
        self.positions |= dict.fromkeys(self._meant(message.servo_id), message.position)

    def on_move_prepare(self, message: MovePrepare) -> None:
        self._prepared |= dict.fromkeys(self._meant(message.servo_id), message.position)

    def on_move_start(self, message: MoveStart) -> None:
        for number in self._meant(message.servo_id):
            self.positions[number] = self._prepared.pop(number, self.positions[number])

    def on_servo_id_write(self, message: ServoIdWrite) -> None:
        for number in self._meant(message.servo_id):
            self.positions[message.new_id] = self.positions.pop(number)
        self.addresses = frozenset(self.positions)

    def on_servo_id_read(self, message: ServoIdRead) -> None:
        # The one question to all that is answered.
        for number in self._meant(message.servo_id):
            self.send(ServoId(number, number))

    def on_position_read(self, message: PositionRead) -> Position:
        return Position(message.servo_id, self.positions[message.servo_id])

    def on_offset_read(self, message: OffsetRead) -> Offset:
        return Offset(message.servo_id, 0)

    def on_temperature_read(self, message: TemperatureRead) -> Temperature:
        return Temperature(message.servo_id, 31)

    def on_voltage_read(self, message: VoltageRead) -> Voltage:
        return Voltage(message.servo_id, 7400)


class ServoBus:
    """A port with servos behind it, by TCP."""

    def __init__(self, *numbers: int) -> None:
        self.servos = Servos(*numbers)
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = f"socket://127.0.0.1:{self._listening.getsockname()[1]}"
        self._ended = False
        self._thread = threading.Thread(target=self._serve, name="servo bus")

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended = True
        socket.create_connection(self._listening.getsockname()).close()
        self._thread.join()
        self._listening.close()

    def _serve(self) -> None:
        """Serve one caller after the other."""
        while not self._ended:
            line, _ = self._listening.accept()
            with line, contextlib.suppress(ConnectionError):
                while data := line.recv(4096):
                    line.sendall(self.servos.receive(data))
