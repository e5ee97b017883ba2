"""Clients that others wrote, each with the same calls: what it can do and what it cannot.

`xarm` and `lewansoul-lx16a` are themselves, from the package index. The module of the latter that
speaks to the controller is in its repository only, and no part of the package: in its place stands
a client written for these tests after how it behaves on the wire.
"""

import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
import serial
from busservo_simulator import VirtualController

from tests.timeouts import GENEROUS, await_that

MISSING = "{} is not installed: it is in the dependency group `test`"
# How long each waits for an answer that does not come. They would wait a second.
SILENCE = 0.03


class OtherClient:
    """The calls that a user would make, as far as a client has them.

    Before an answer is read, it is waited for: `answer` bytes, 0 if none will come.
    """

    name: str
    answer = 0
    _line: Any

    def close(self) -> None:
        self._line.close()


class Xarm(OtherClient):
    """The client `xarm`: it reads two bytes more than an answer has, so it always times out."""

    name = "`xarm` 0.0.4"

    def __init__(self, board: VirtualController) -> None:
        self._module: Any = pytest.importorskip("xarm", reason=MISSING.format("xarm"))
        # It takes a port only by a name that begins with COM.
        with pytest.MonkeyPatch.context() as patch:
            patch.chdir(Path(board.port).parent)
            self._arm = self._module.Controller(Path(board.port).name)
        self._line = self._arm._device
        self._line.timeout = SILENCE
        self._receive = self._arm._recv
        self._arm._recv = self._wait_for_reply

    def _wait_for_reply(self, command: int) -> object:
        await_that(lambda: self._line.in_waiting >= self.answer)
        return self._receive(command)

    def move(self, targets: Sequence[tuple[int, int]]) -> None:
        self._arm.setPosition([list(target) for target in targets], duration=0)

    def battery(self) -> object:
        volts = self._arm.getBatteryVoltage()
        return volts if volts is None else round(1000 * volts)

    def positions(self, servo_ids: Sequence[int]) -> object:
        servos = [self._module.Servo(servo_id) for servo_id in servo_ids]
        self._arm.getPosition(servos)
        return [servo.position for servo in servos]

    def unload(self, servo_ids: Sequence[int]) -> None:
        self._arm.servoOff(list(servo_ids))


class LewansoulLx16a(OtherClient):
    """The client `lewansoul-lx16a`: it speaks to the servos themselves, in their own protocol."""

    name = "`lewansoul-lx16a` 0.1"

    def __init__(self, board: VirtualController) -> None:
        name = "lewansoul_lx16a"
        module: Any = pytest.importorskip(name, reason=MISSING.format("lewansoul-lx16a"))
        self._line = serial.Serial(board.port, 9600)
        self._servos = module.ServoController(self._line, timeout=SILENCE)

    def move(self, targets: Sequence[tuple[int, int]]) -> None:
        for servo_id, position in targets:
            self._servos.move(servo_id, position)

    def battery(self) -> object:
        return self._servos.get_voltage(1)

    def positions(self, servo_ids: Sequence[int]) -> object:
        return [self._servos.get_position(servo_id) for servo_id in servo_ids]

    def unload(self, servo_ids: Sequence[int]) -> None:
        for servo_id in servo_ids:
            self._servos.motor_off(servo_id)


class NextFrame(OtherClient):
    """A client that takes the next frame with a header for the answer, whatever its command is."""

    name = "its controller module"

    def __init__(self, board: VirtualController) -> None:
        self._line = serial.Serial(board.port, 9600)

    def _send(self, command: int, parameters: bytes) -> None:
        self._line.write(bytes([0x55, 0x55, len(parameters) + 2, command]) + parameters)

    def _receive(self) -> bytes:
        self._line.timeout = GENEROUS if self.answer else SILENCE
        headers = 0
        while headers < 2:
            byte = self._line.read()
            if not byte:
                raise TimeoutError
            headers = headers + 1 if byte == b"\x55" else 0
        length, _command = self._line.read(2)
        return bytes(self._line.read(length - 2))

    def move(self, targets: Sequence[tuple[int, int]]) -> None:
        each = b"".join(struct.pack("<BH", *target) for target in targets)
        self._send(3, struct.pack("<BH", len(targets), 0) + each)

    def battery(self) -> object:
        self._send(15, b"")
        return int.from_bytes(self._receive()[:2], "little")

    def positions(self, servo_ids: Sequence[int]) -> object:
        self._send(21, bytes([len(servo_ids), *servo_ids]))
        data = self._receive()
        positions = dict(struct.unpack_from("<BH", data, 1 + 3 * at) for at in range(data[0]))
        return [positions[servo_id] for servo_id in servo_ids]

    def unload(self, servo_ids: Sequence[int]) -> None:
        self._send(20, bytes([len(servo_ids), *servo_ids]))


CLIENTS: dict[str, Any] = {each.name: each for each in (Xarm, LewansoulLx16a, NextFrame)}
