"""The command of a library whose devices have addresses: what it sends, and whom it asks."""

import json
import socket
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import lxservo
import pytest
from lxservo.__main__ import main

from tests import timeouts
from tests.in_turn import in_turn


class Servos(lxservo.Device):
    """Servos 1 and 3: each answers what it is asked, and all tell their numbers."""

    def on_position_read(self, message: lxservo.PositionRead) -> lxservo.Position:
        return lxservo.Position(message.servo_id, position=100 * message.servo_id)

    def on_move_read(self, message: lxservo.MoveRead) -> lxservo.LastMove:
        return lxservo.LastMove(message.servo_id, position=1, time_ms=2)

    def on_servo_id_read(self, message: lxservo.ServoIdRead) -> lxservo.ServoId:
        for each in sorted(self.addresses) if message.servo_id == 254 else ():
            self.send(lxservo.ServoId(each, own_id=each))
        return lxservo.ServoId(message.servo_id, own_id=message.servo_id)


@pytest.fixture(scope="module")
def port() -> Iterator[str]:
    """Return the address of a line to them, for one client at a time."""
    device = Servos(1, 3)
    with socket.create_server(("127.0.0.1", 0)) as server, ThreadPoolExecutor() as pool:

        def serve() -> None:
            with suppress(OSError):
                while True:
                    line, _ = server.accept()
                    with line:
                        while data := line.recv(4096):
                            line.sendall(device.receive(data))

        pool.submit(serve)
        yield f"socket://127.0.0.1:{server.getsockname()[1]}"
        server.shutdown(socket.SHUT_RDWR)


@pytest.fixture(autouse=True)
def undoubted() -> Iterator[None]:
    with timeouts.undoubted():
        yield


def sent(port: str, *words: str) -> list[str]:
    return ["send", "--port", port, "--baud", "inf", "--json", *words]


def test_a_question_to_one_device_prints_its_reply(
    port: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(sent(port, "PositionRead", "servo_id=3")) == 0
    assert json.loads(capsys.readouterr().out)["fields"] == {"servo_id": 3, "position": 300}


def test_a_question_to_all_prints_every_reply(
    port: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(sent(port, "ServoIdRead", "servo_id=all")) == 0
    replies = [json.loads(line)["fields"] for line in capsys.readouterr().out.splitlines()]
    assert replies == [{"servo_id": 1, "own_id": 1}, {"servo_id": 3, "own_id": 3}]


def test_who_does_not_answer_is_told(port: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(sent(port, "PositionRead", "servo_id=2", "--timeout", "0.1")) == 1
    assert "no Position came within" in capsys.readouterr().err


@in_turn(
    "servo, problem", lambda: [(254, "no device answers at 254"), (255, "255 is outside 0..254")]
)
def test_the_doctor_asks_nobody_who_cannot_answer(
    port: str, servo: int, problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["doctor", "--port", port, "--servo-id", str(servo)]) == 2
    assert f"--servo-id: {problem}" in capsys.readouterr().err


def test_the_doctor_asks_the_device_that_is_named(
    port: str, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["doctor", "--port", port, "--servo-id", "3", "--timeout", "0.1", "--json"])
    found = {each["check"]: each for each in map(json.loads, capsys.readouterr().out.splitlines())}
    assert found["reply"]["state"] == "passed"
    assert "LastMove(servo_id=3," in found["reply"]["seen"]
