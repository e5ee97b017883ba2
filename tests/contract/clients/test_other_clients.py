"""Clients that others wrote, odd habits included: all are served.

One of them is `xarm` itself, from the package index, where it is installed. The rest were written
for this test, after what such programs are seen to do on the wire.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import serial
from busservo_simulator import Faults, VirtualController

from tests.contract.clients.other_clients import MISSING
from tests.timeouts import await_that

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
READ_TWO = bytes.fromhex("55 55 05 15 02 01 02")


@pytest.fixture
def board(tmp_path: Path) -> Iterator[VirtualController]:
    with VirtualController("pty", link=tmp_path / "COM7", baud=9600) as board:
        yield board


@pytest.fixture
def line(board: VirtualController) -> Iterator[serial.Serial]:
    with serial.Serial(board.port, 9600, timeout=0.1) as line:
        yield line


def await_answer(line: serial.Serial, size: int) -> None:
    """Wait until an answer is complete, before the timeout of a client for it begins."""
    await_that(lambda: line.in_waiting >= size)


def test_a_client_that_writes_in_two_parts_and_reads_two_bytes_too_many_is_served(
    board: VirtualController, line: serial.Serial
) -> None:
    for _ in range(3):
        line.flush()
        line.write(READ_TWO[:4])
        line.write(READ_TWO[4:])
        await_answer(line, 11)
        head = line.read(4)
        assert head == bytes.fromhex("55 55 09 15")
        assert line.read(head[2]) == bytes.fromhex("02 01 F4 01 02 F4 01")
    assert (board.accepted, board.rejects.total) == (3, 0)


def test_a_client_that_clears_its_input_first_is_served(
    board: VirtualController, line: serial.Serial
) -> None:
    board.faults = Faults(seed=1, noise=0.5, splits=0.5, unsolicited=0.5)
    for _ in range(10):
        line.reset_input_buffer()
        line.write(READ_TWO)
        data = bytearray()

        def answered(data: bytearray = data) -> bool:
            data += line.read(max(1, line.in_waiting))
            return b"\x55\x55\x09\x15\x02" in data[:-6]

        await_that(answered)
        found = data.index(b"\x55\x55\x09\x15\x02")
        assert data[found + 5 : found + 11] == bytes.fromhex("01 F4 01 02 F4 01")
    assert board.rejects.total == 0


def test_a_client_that_sends_and_closes_is_served(tmp_path: Path) -> None:
    with VirtualController("pty", link=tmp_path / "COM7") as board:
        for _ in range(3):
            with serial.Serial(board.port, 9600) as line:
                line.write(bytes.fromhex("55 55 05 06 08 01 00"))
                line.write(bytes.fromhex("55 55 08 03 01 E8 03 01 20 03"))
        await_that(lambda: board.accepted >= 6)
        assert (board.accepted, board.rejects.total) == (6, 0)
        assert board.servos[1].target == 800


def test_xarm_is_served(board: VirtualController, monkeypatch: pytest.MonkeyPatch) -> None:
    """It takes a port only by a name that begins with COM, and waits a second for each answer:
    here, what is left of it begins when the answer has come, however busy the machine is.
    """
    xarm = pytest.importorskip("xarm", reason=MISSING.format("xarm"))
    link = Path(board.port)
    monkeypatch.chdir(link.parent)
    arm = xarm.Controller(link.name)
    arm._device.timeout = 0.05
    send, sizes = arm._send, iter([6, 23, 8])

    def paced(command: int, *data: object) -> None:
        send(command, *data)
        if command in (arm.CMD_GET_BATTERY_VOLTAGE, arm.CMD_GET_SERVO_POSITION):
            await_answer(arm._device, next(sizes))

    monkeypatch.setattr(arm, "_send", paced)
    arm.setPosition([[1, 700], [2, 300]], duration=0)
    await_that(lambda: (board.servos[1].position, board.servos[2].position) == (700, 300))
    assert arm.getBatteryVoltage() == pytest.approx(7.5, abs=0.1)
    servos = [xarm.Servo(number) for number in range(1, 7)]
    arm.getPosition(servos)
    assert [servo.position for servo in servos] == [700, 300, 500, 500, 500, 500]
    arm.servoOff()
    assert arm.getPosition(3) == 500
    assert not any(servo.loaded for servo in board.servos.values())
    assert (board.accepted, board.rejects.total) == (5, 0)
    arm._device.close()
