"""The limits of what is sent, usual ones and those of each servo; and the ids of a client."""

import pickle
from typing import Any

import lxservo
import pytest
from busservo import AsyncController, Controller, LimitError, ServoMove
from busservo_simulator import VirtualController
from framewire.client.limits import Limits

from tests.in_turn import in_turn
from tests.lines.both_clients import PORT_TALKS, Talk
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.timeouts import LIVE

CLIENTS = (Controller, AsyncController)
OWN = {1: (100, 900), 2: None, 3: (500, 2500)}
PWM = "limits=(500, 2500) is for PWM servo boards, "
USUAL, ANY = "limits=(0, 1000) is for what is usual, ", "limits=None for any"
READ = "targets_of() makes targets of what was read; limits=None sends anything"


def beyond(place: int, position: int, limits: str) -> str:
    return f"targets[{place}].position: {position} is outside the limits {limits}; "


# Under which limits what is sent to whom, and what refuses it: none if it is inside of them.
SENT: list[tuple[Any, list[tuple[int, int]], str]] = [
    ((0, 1000), [(1, 0), (2, 1000)], ""),
    ((500, 2500), [(1, 500), (2, 2500)], ""),
    (None, [(1, 0), (2, 65535)], ""),
    ([3, 4], [(1, 3), (2, 4)], ""),
    ((0, 1000), [(1, 800), (2, 1001)], beyond(1, 1001, "0..1000") + PWM + ANY),
    ((0, 1000), [(1, 65535)], beyond(0, 65535, "0..1000") + READ),
    ((500, 2500), [(1, 499)], beyond(0, 499, "500..2500") + USUAL + ANY),
    ((100, 800), [(1, 900)], beyond(0, 900, "100..800") + USUAL + PWM + ANY),
    (OWN, [(1, 100), (1, 900)], ""),
    (OWN, [(1, 99)], beyond(0, 99, "100..900 of servo 1")),
    (OWN, [(1, 901)], beyond(0, 901, "100..900 of servo 1")),
    (OWN, [(2, 65535)], ""),
    (OWN, [(3, 2500), (4, 1000), (4, 0)], ""),
    (OWN, [(3, 499)], beyond(0, 499, "500..2500 of servo 3")),
    (OWN, [(4, 1001)], beyond(0, 1001, "0..1000 of servo 4")),
    (OWN, [(2, 5000), (1, 500), (1, 950)], beyond(2, 950, "100..900 of servo 1")),
]


@in_turn("limits, targets, refusal", lambda: SENT)
def test_what_is_outside_the_limits_is_refused_and_never_sent(
    limits: Any, targets: list[tuple[int, int]], refusal: str
) -> None:
    line = VirtualLine()
    move = ServoMove(targets=targets, time_ms=10)
    with client_on(line, Controller, limits=limits, settle=None) as controller:
        for send in (controller.send, controller.send_latest):
            if not refusal:
                send(move)
                continue
            with pytest.raises(LimitError) as refused:
                send(move)
            error = refused.value
            assert str(error).startswith(refusal)
            assert limits is OWN or str(error) == refusal
            low, high = error.limits
            said = f"{error.path}: {error.value} is outside the limits {low}..{high}"
            assert refusal.startswith(said + (f" of {error.owner}; " if error.owner else "; "))
            assert str(pickle.loads(pickle.dumps(error))) == str(error)  # noqa: S301 - our own
    assert line.received == ([] if refusal else [move, move])


LOWEST = r"limits is .* must be the lowest and the highest.* such as \(0, 1000\), or None for any"


@in_turn(
    "limits, problem",
    lambda: [
        *((each, LOWEST) for each in [(1000, 0), (1,), 1000, "0..1000", (0, 1.5), (1, 2, 3), ()]),
        ({1: (900, 100)}, r"limits\[1\] is \(900, 100\), and must be the lowest"),
        ({1: 5}, r"limits\[1\] is 5, and must be the lowest"),
        ({"1": (0, 9)}, r"limits has '1', and must have numbers, such as \{1: \(0, 1000\)\}"),
    ],
)
def test_limits_that_can_be_nobodys_are_refused_with_what_can(limits: Any, problem: str) -> None:
    for client in CLIENTS:
        with pytest.raises(ValueError, match=problem):
            client(VirtualLine(), limits=limits)


def test_nothing_else_has_limits() -> None:
    beyond = ServoMove(time_ms=100, targets=[(1, 800), (2, 1001)])
    assert ServoMove.decode(beyond.encode()) == beyond
    line = VirtualLine()
    with client_on(line, Controller, settle=None) as controller:
        controller.set_action_group_speed(255, percent=65535)
        controller.run_action_group(255, times=65535)
    assert len(line.received) == 2
    assert Limits().chosen(None) is None
    with pytest.raises(ValueError, match="nothing that is sent here has limits"):
        Limits().chosen((0, 1))


@pytest.mark.parametrize("talk", PORT_TALKS)
def test_a_port_is_opened_with_limits_and_ids(talk: Talk) -> None:
    beyond = ServoMove(time_ms=100, targets=[(1, 1001)])

    async def usual(controller: Any) -> None:
        with pytest.raises(LimitError):
            await controller.send(beyond)
        with pytest.raises(LimitError):
            controller.send_latest(beyond)
        with pytest.raises(ValueError, match="ids: give them here"):
            await controller.read_servo_positions()

    async def chosen(controller: Any) -> None:
        await controller.send(beyond)
        read = await controller.read_servo_positions()
        assert [each.servo_id for each in read] == [3, 2]

    with VirtualController("tcp") as board:
        talk(board.port, usual)
        for limits in ((500, 2500), None):
            talk(board.port, chosen, **LIVE, ids=[3, 2], limits=limits)


# ------------------------------------------------------------------ the ids of a client

NO_IDS = [
    ((0,), r"ids has 0, and a servo is 1\.\.253"),
    ((254,), "ids has 254"),
    ("1,2", "numbers"),
]


@in_turn("ids, problem", lambda: NO_IDS)
def test_ids_of_no_servo_are_refused(ids: Any, problem: str) -> None:
    for client in CLIENTS:
        with pytest.raises(ValueError, match=problem):
            client(VirtualLine(), ids=ids)


def test_a_protocol_without_a_pose_takes_no_ids_and_no_limits() -> None:
    for client in (lxservo.Controller, lxservo.AsyncController):
        with pytest.raises(ValueError, match="nothing that is asked here takes a list of ids"):
            client(VirtualLine(), ids=(1,))
        with pytest.raises(ValueError, match="nothing that is sent here has limits"):
            client(VirtualLine(), limits={1: (0, 9)})
