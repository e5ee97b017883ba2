"""Limits of each servo, and the servos that a client asks about by itself."""

import asyncio
import math
import pickle
from typing import Any

import lxservo
import pytest
from busservo import (
    AsyncController,
    Controller,
    LimitError,
    ServoMove,
    ServoPositions,
    open_async_controller,
)
from busservo._exchanges import LIMITS, POSE
from busservo_simulator import VirtualController

from tests.factories import DEMO, library, library_of
from tests.in_turn import in_turn
from tests.lines.timed_line import client_of, client_on
from tests.lines.virtual_line import VirtualLine

OWN = {1: (100, 900), 2: None, 3: (500, 2500)}
# What is sent to whom, and whose limits refuse it at which place.
CASES = [
    ([(1, 100), (1, 900)], None),
    ([(1, 99)], (0, 99, (100, 900), "servo 1")),
    ([(1, 901)], (0, 901, (100, 900), "servo 1")),
    ([(2, 65535)], None),
    ([(3, 2500), (4, 1000), (4, 0)], None),
    ([(3, 499)], (0, 499, (500, 2500), "servo 3")),
    ([(4, 1001)], (0, 1001, (0, 1000), "servo 4")),
    ([(2, 5000), (1, 500), (1, 950)], (2, 950, (100, 900), "servo 1")),
]


@in_turn("targets, refusal", lambda: CASES)
def test_each_servo_is_held_to_its_own_limits(targets: Any, refusal: Any) -> None:
    line = VirtualLine()
    with client_on(line, Controller, limits=OWN, settle=None) as controller:
        for send in (controller.send, controller.send_latest):
            if refusal is None:
                send(ServoMove(targets=targets, time_ms=10))
                continue
            with pytest.raises(LimitError) as refused:
                send(ServoMove(targets=targets, time_ms=10))
            at, value, limits, owner = refusal
            error = refused.value
            assert (error.path, error.value, error.limits, error.owner) == (
                f"targets[{at}].position",
                value,
                limits,
                owner,
            )
            low, high = limits
            assert f": {value} is outside the limits {low}..{high} of {owner}; " in str(error)
            assert str(pickle.loads(pickle.dumps(error))) == str(error)  # noqa: S301 - our own
    assert len(line.received) == (2 if refusal is None else 0)


@in_turn(
    "limits, problem",
    lambda: [
        ({1: (900, 100)}, r"limits\[1\] is \(900, 100\), and must be the lowest"),
        ({1: 5}, r"limits\[1\] is 5, and must be the lowest"),
        ({"1": (0, 9)}, r"limits has '1', and must have numbers, such as \{1: \(0, 1000\)\}"),
    ],
)
def test_limits_that_can_be_nobodys_are_refused(limits: Any, problem: str) -> None:
    for client in (Controller, AsyncController):
        with pytest.raises(ValueError, match=problem):
            client(VirtualLine(), limits=limits)


def test_positions_that_were_read_are_held_within_the_limits_of_each() -> None:
    assert POSE is not None
    read = ServoPositions([(1, 95), (4, 1010), (2, 4000)]).positions
    assert POSE.targets_of(read, LIMITS.chosen(OWN)) == [(1, 100), (4, 1000), (2, 4000)]
    with pytest.raises(LimitError, match=r"50 is outside the limits 100\.\.900 of servo 1; "):
        POSE.targets_of(ServoPositions([(1, 50)]).positions, LIMITS.chosen(OWN))


@in_turn(
    "ids, problem",
    lambda: [
        ((0,), r"ids has 0, and a servo is 1\.\.253"),
        ((254,), "ids has 254"),
        ("1,2", "numbers"),
    ],
)
def test_ids_of_no_servo_are_refused(ids: Any, problem: str) -> None:
    for client in (Controller, AsyncController):
        with pytest.raises(ValueError, match=problem):
            client(VirtualLine(), ids=ids)


def test_a_protocol_without_a_pose_takes_no_ids_and_no_limits() -> None:
    for client in (lxservo.Controller, lxservo.AsyncController):
        with pytest.raises(ValueError, match="nothing that is asked here takes a list of ids"):
            client(VirtualLine(), ids=(1,))
        with pytest.raises(ValueError, match="nothing that is sent here has limits"):
            client(VirtualLine(), limits={1: (0, 9)})


NO_IDS = "ids: give them here, or as ids=… when the client is opened"


def test_positions_are_read_of_the_ids_of_the_client() -> None:
    with library(library_of(DEMO.with_name("blinds.yaml"))) as blinds:
        asked: list[tuple[int, ...]] = []

        class Motor(blinds.Device):  # type: ignore[misc, name-defined]
            def on_blinds_read(self, message: Any) -> Any:
                asked.append(tuple(message.blind_ids))
                return blinds.BlindsState([(each, 7) for each in message.blind_ids])

        with client_of(Motor(), ids=(4, 9, 4)) as hub:
            assert [each.blind_id for each in hub.read_heights()] == [4, 9]
            assert [each.blind_id for each in hub.read_heights([5])] == [5]
        with client_of(Motor()) as hub, pytest.raises(ValueError, match=NO_IDS):
            hub.read_heights()
        assert asked == [(4, 9), (5,)]


def test_a_client_for_asyncio_asks_about_its_ids_as_well() -> None:
    async def by_tasks(port: str) -> None:
        async with open_async_controller(port, baud=math.inf, ids=[3, 2]) as controller:
            read = await controller.read_servo_positions()
            assert [each.servo_id for each in read] == [3, 2]
        async with open_async_controller(port, baud=math.inf) as controller:
            with pytest.raises(ValueError, match="ids: give them here"):
                await controller.read_servo_positions()

    with VirtualController("tcp") as board:
        asyncio.run(by_tasks(board.port))
