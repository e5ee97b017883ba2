"""The command of a library whose devices have addresses: what it sends, and whom it asks."""

import json
from collections.abc import Iterator
from typing import Any

import lxservo.__main__
import pytest
from lxservo_simulator import VirtualBus

from tests.commands import Ended, run
from tests.timeouts import undoubted


@pytest.fixture
def bus() -> Iterator[VirtualBus]:
    """Yield servos 1 and 3."""
    with VirtualBus("tcp", servos=[1, 3]) as bus, undoubted():
        yield bus


def called(bus: VirtualBus, verb: str, words: str) -> Ended:
    return run(verb, "--port", bus.port, *words.split(), main=lxservo.__main__.main)


def replies(bus: VirtualBus, words: str) -> list[dict[str, Any]]:
    """Return the fields of what answers, as it is printed."""
    status, output, errors = called(bus, "send", f"--baud inf --json {words}")
    assert (status, errors) == (0, "")
    return [json.loads(line)["fields"] for line in output.splitlines()]


def test_a_question_to_one_device_prints_its_reply_and_one_to_all_every_reply(
    bus: VirtualBus,
) -> None:
    assert replies(bus, "PositionRead servo_id=3") == [{"servo_id": 3, "position": 500}]
    own = [{"servo_id": each, "own_id": each} for each in (1, 3)]
    assert replies(bus, "ServoIdRead servo_id=all") == own


def test_who_does_not_answer_is_told(bus: VirtualBus) -> None:
    ended = called(bus, "send", "--baud inf PositionRead servo_id=2 --timeout 0.1")
    assert (ended.status, "no Position came within" in ended.err) == (1, True)


def test_the_doctor_asks_the_device_that_is_named_and_nobody_who_cannot_answer(
    bus: VirtualBus,
) -> None:
    for servo, problem in (("254", "no device answers at 254"), ("255", "255 is outside 0..254")):
        ended = called(bus, "doctor", f"--servo-id {servo}")
        assert (ended.status, f"--servo-id: {problem}" in ended.err) == (2, True)
    output = called(bus, "doctor", "--servo-id 3 --timeout 0.1 --json").out
    found = {each["check"]: each for each in map(json.loads, output.splitlines())}
    assert found["reply"]["state"] == "passed"
    assert "LastMove(servo_id=3," in found["reply"]["seen"]
