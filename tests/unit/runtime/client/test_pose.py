"""Limits, absent servos, holding, and which are present: for threads and for asyncio."""

from __future__ import annotations

import asyncio
import pickle
from functools import partial
from typing import TYPE_CHECKING, Any

import busservo
import pytest
from busservo import (
    AbsentError,
    AsyncController,
    Controller,
    EncodeError,
    IncompleteReplyError,
    LimitError,
    NoReplyError,
    ServoMove,
    ServoPosition,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
)
from busservo._exchanges import LIMITS, POSE
from busservo_simulator import Faults, VirtualController
from framewire.client.limits import Limits

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.timeouts import LIVE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

OFF = ServoPosition.POSITION_ABSENT
MOVE_BEYOND = ServoMove(time_ms=100, targets=[(1, 800), (2, 1001)])


def virtual(servos: Iterable[int] = range(1, 7), **given: Any) -> tuple[VirtualController, Any]:
    """Return a board in virtual time, and a function that makes a client of it."""
    board = virtual_board(servos=servos, **given)
    return board, partial(client_at, board, Controller, settle=None)


def moves(line: VirtualLine) -> list[ServoMove]:
    return [each for each in line.received if isinstance(each, ServoMove)]


def client_of(line: VirtualLine, **given: Any) -> Any:
    return client_on(line, Controller, settle=None, **given)


# ------------------------------------------------------------------ what a position means


@in_turn(
    "position, signed, absent",
    lambda: [
        (0, 0, False),
        (500, 500, False),
        (1000, 1000, False),
        (32767, 32767, False),
        (32768, -32768, False),
        (65531, -5, False),
        (65534, -2, False),
        (65535, -1, True),
    ],
)
def test_a_position_stays_raw_and_has_its_meaning_beside_it(
    position: int, signed: int, absent: bool
) -> None:
    [read] = ServoPositions([(4, position)]).positions
    assert (read.position, read.signed_position, read.absent) == (position, signed, absent)
    assert read == (4, position)
    assert repr(read) == f"ServoPosition(servo_id=4, position={position})"


def test_derived_properties_cannot_be_set() -> None:
    read = ServoPosition(1, 500)
    for name in ("signed_position", "absent"):
        with pytest.raises(AttributeError):
            setattr(read, name, 1)


# ------------------------------------------------------------------ limits


REFUSED: list[tuple[ServoMove, tuple[int, int], str]] = [
    (
        MOVE_BEYOND,
        (0, 1000),
        (
            "targets[1].position: 1001 is outside the limits 0..1000; "
            "limits=(500, 2500) is for PWM servo boards, limits=None for any"
        ),
    ),
    (
        ServoMove(time_ms=0, targets=[(1, 65535)]),
        (0, 1000),
        (
            "targets[0].position: 65535 is outside the limits 0..1000; "
            "targets_of() makes targets of what was read; limits=None sends anything"
        ),
    ),
    (
        ServoMove(time_ms=0, targets=[(1, 499)]),
        (500, 2500),
        (
            "targets[0].position: 499 is outside the limits 500..2500; "
            "limits=(0, 1000) is for what is usual, limits=None for any"
        ),
    ),
    (
        ServoMove(time_ms=0, targets=[(1, 900)]),
        (100, 800),
        (
            "targets[0].position: 900 is outside the limits 100..800; "
            "limits=(0, 1000) is for what is usual, limits=(500, 2500) is for PWM servo boards, "
            "limits=None for any"
        ),
    ),
]


@in_turn("move, limits, expected", lambda: REFUSED)
def test_what_is_outside_the_limits_is_refused_and_never_sent(
    move: ServoMove, limits: tuple[int, int], expected: str
) -> None:
    line = VirtualLine()
    with client_of(line, limits=limits) as controller:
        for send in (controller.send, controller.send_latest):
            with pytest.raises(LimitError) as refused:
                send(move)
            assert str(refused.value) == expected
            assert refused.value.limits == limits
    assert line.received == []


def test_a_refusal_is_an_encode_error_that_can_be_pickled() -> None:
    error = LimitError("targets[0].position", 1500, (0, 1000), LIMITS.way_out(1500))
    assert isinstance(error, EncodeError)
    assert isinstance(error, ValueError)
    assert str(pickle.loads(pickle.dumps(error))) == str(error)  # noqa: S301 - our own
    assert (error.path, error.value, error.limits) == ("targets[0].position", 1500, (0, 1000))


@in_turn(
    "limits, positions",
    lambda: [
        ((0, 1000), [0, 1000]),
        ((500, 2500), [500, 2500]),
        (None, [0, 65535]),
        ([3, 4], [3, 4]),
    ],
)
def test_the_ends_of_the_limits_are_inside(limits: Any, positions: list[int]) -> None:
    line = VirtualLine()
    with client_of(line, limits=limits) as controller:
        controller.move_servos(list(enumerate(positions)), time_ms=100)
    assert [move.columns()[1] for move in moves(line)] == [tuple(positions)]


@in_turn("limits", lambda: [(1000, 0), (1,), 1000, "0..1000", (0, 1.5), (1, 2, 3), ()])
def test_limits_that_can_be_none_are_refused_with_what_can(limits: Any) -> None:
    with pytest.raises(ValueError, match=r"such as \(0, 1000\), or None for any"):
        client_of(VirtualLine(), limits=limits)
    with pytest.raises(ValueError, match="lowest and the highest"):
        AsyncController(VirtualLine(), limits=limits)


def test_a_protocol_without_limits_has_nothing_to_limit() -> None:
    assert Limits().chosen(None) is None
    with pytest.raises(ValueError, match="nothing that is sent here has limits"):
        Limits().chosen((0, 1))


def test_the_codec_has_no_limits() -> None:
    assert ServoMove.decode(MOVE_BEYOND.encode()) == MOVE_BEYOND


def test_other_messages_have_no_limits() -> None:
    line = VirtualLine()
    with client_of(line) as controller:
        controller.set_action_group_speed(255, percent=65535)
        controller.run_action_group(255, times=65535)
    assert len(line.received) == 2


# ------------------------------------------------------------------ who is there


def test_present_servos_are_found_without_an_error() -> None:
    board, client = virtual(servos=[1, 2, 84, 85, 86, 253])
    with board, client() as controller:
        board.servos[2].off = True
        assert controller.present_servos() == (1, 84, 85, 86, 253)
        assert controller.present_servos([9, 253, 2, 1]) == (253, 1)
        assert controller.present_servos([7]) == ()
        assert controller.counters.timeouts == 0


def test_all_servos_are_requested_in_as_many_parts_as_replies_need() -> None:
    board, client = virtual(servos=range(1, 254), baud=9600)
    with board, client(settle=0) as controller:
        began = board.clock.now()
        assert controller.present_servos() == (*range(1, 254),)
        # 84, 84, 84 and 1 of them: the bytes of four questions and their replies, and no more.
        size = 3 * (89 + 257) + (6 + 8)
        assert controller.counters.sent == 4
        assert board.clock.now() - began == pytest.approx(size / 960, abs=0.06)


def test_silence_while_looking_for_servos_is_an_error() -> None:
    answered = ServoPositions([(1, 500)])
    line = VirtualLine(lambda _: [] if line.received[1:] else [(0.0, answered)])
    with client_of(line) as controller, pytest.raises(NoReplyError):
        controller.present_servos(range(1, 100))


def test_servo_ids_are_checked_before_anything_is_sent() -> None:
    line = VirtualLine()
    with client_of(line) as controller:
        for wrong in ([300], ["1"], 5, []):
            with pytest.raises(EncodeError):
                controller.present_servos(wrong)
    assert line.received == []


# ------------------------------------------------------------------ holding, and going back


def test_holding_commands_the_positions_just_read() -> None:
    board, client = virtual()
    with board, client() as controller:
        controller.move_servos([(1, 1000), (2, 0)], time_ms=1000)
        board.advance(0.4)
        controller.hold_servos([1, 2])
        board.advance(1)
        first, second = controller.read_servo_positions([1, 2])
        assert 600 < first.position < 800
        assert 200 < second.position < 400


def answering(positions: list[tuple[int, int]]) -> Callable[[Any], list[tuple[float, Any]]]:
    """Return a board that answers every question about positions alike."""

    def answer(message: Any) -> list[tuple[float, Any]]:
        requested = isinstance(message, ServoPositionsRead)
        return [(0.0, ServoPositions(positions))] if requested else []

    return answer


def test_nothing_is_sent_where_one_of_those_to_hold_is_not_there() -> None:
    line = VirtualLine(answering([(1, 500), (2, OFF), (4, 600)]))
    with client_of(line) as controller, pytest.raises(AbsentError) as refused:
        controller.hold_servos([1, 2, 3, 4])
    assert moves(line) == []
    assert refused.value.missing == (2, 3)
    assert refused.value.arrived == ((1, 500), (4, 600))
    assert isinstance(refused.value, IncompleteReplyError)
    problem = "nothing was sent, since these are off or missing: servo_ids 2, 3; "
    assert str(refused.value) == problem + "2 did arrive"


def test_more_than_one_frame_moves_are_held_by_none() -> None:
    line = VirtualLine(answering([(number, 500) for number in range(84)]))
    with (
        client_of(line) as controller,
        pytest.raises(EncodeError, match=r"84 items is outside 1\.\.83"),
    ):
        controller.hold_servos(range(84))
    assert moves(line) == []


AT_THE_STOPS: list[tuple[Any, list[tuple[int, int]], list[tuple[int, int]]]] = [
    ((0, 1000), [(1, 65531), (2, 1003), (3, 500)], [(1, 0), (2, 1000), (3, 500)]),
    ((0, 1000), [(1, 65486), (2, 1050)], [(1, 0), (2, 1000)]),
    ((500, 2500), [(1, 400), (2, 2600)], [(1, 500), (2, 2500)]),
    (None, [(1, 65531), (2, 1003), (3, 40000)], [(1, 0), (2, 1003), (3, 40000)]),
]


@in_turn("limits, read, targets", lambda: AT_THE_STOPS)
def test_what_is_at_its_stop_is_held_and_replayed_inside_the_limits(
    limits: Any, read: list[tuple[int, int]], targets: list[tuple[int, int]]
) -> None:
    line = VirtualLine(answering(read))
    with client_of(line, limits=limits) as controller:
        controller.hold_servos([number for number, _ in read], time_ms=40)
        pose = ServoPositions([*read, (9, OFF)]).positions
        assert controller.targets_of(pose) == targets
    assert moves(line) == [ServoMove(time_ms=40, targets=targets)]


@in_turn(
    "limits, position, expected",
    lambda: [
        ((0, 1000), 1051, "limits=(500, 2500) is for PWM servo boards, limits=None for any"),
        (
            (0, 1000),
            65485,
            "positions[1].position: 65485 is outside the limits 0..1000; limits=None",
        ),
        ((500, 2500), 399, "limits=(0, 1000) is for what is usual, limits=None for any"),
        ((500, 2500), 65531, "limits=None sends anything"),
    ],
)
def test_what_is_far_outside_the_limits_is_not_sent_somewhere_else(
    limits: tuple[int, int], position: int, expected: str
) -> None:
    line = VirtualLine(answering([(1, 500), (2, position)]))
    with client_of(line, limits=limits) as controller:
        with pytest.raises(LimitError) as refused:
            controller.hold_servos([1, 2])
        with pytest.raises(LimitError):
            controller.targets_of(ServoPositions([(1, 500), (2, position)]).positions)
    assert str(refused.value).startswith("positions[1].position: ")
    assert expected in str(refused.value)
    assert moves(line) == []


def test_a_pose_that_was_read_can_be_replayed_whatever_it_holds() -> None:
    board, client = virtual()
    with board, client() as controller:
        board.servos[3].off = True
        pose = controller.read_servo_positions([1, 2, 3])
        with pytest.raises(LimitError, match="65535"):
            controller.move_servos(pose, time_ms=100)
        controller.move_servos(controller.targets_of(pose), time_ms=100)


def test_the_same_for_asyncio() -> None:
    async def run(port: str) -> None:
        async with busservo.open_async_controller(port, **LIVE) as controller:
            assert await controller.present_servos() == (1, 2, 3)
            await controller.hold_servos([1, 2])
            with pytest.raises(AbsentError):
                await controller.hold_servos([1, 7])
            with pytest.raises(LimitError):
                await controller.send(MOVE_BEYOND)
            with pytest.raises(LimitError):
                controller.send_latest(MOVE_BEYOND)
            assert controller.targets_of([ServoPosition(1, OFF), ServoPosition(2, 65531)]) == [
                (2, 0)
            ]
        async with busservo.open_async_controller(port, limits=None) as controller:
            await controller.send(MOVE_BEYOND)

    with VirtualController("tcp", servos=[1, 2, 3]) as board:
        asyncio.run(run(board.port))
        assert board.rejects.total == 0


def test_a_port_is_opened_with_limits() -> None:
    with VirtualController("tcp") as board:
        with busservo.open_controller(board.port) as controller, pytest.raises(LimitError):
            controller.send(MOVE_BEYOND)
        with busservo.open_controller(board.port, limits=(500, 2500)) as controller:
            controller.move_servos([(1, 2500)], time_ms=100)


# ------------------------------------------------------------------ what the spec says of it


def test_the_pose_of_the_protocol() -> None:
    assert (POSE.read, POSE.move, POSE.release) == (ServoPositionsRead, ServoMove, ServoUnload)
    assert POSE.ids == range(1, 254)
    assert (LIMITS.usual, LIMITS.others) == ((0, 1000), {"PWM servo boards": (500, 2500)})


@in_turn("seed", lambda: range(3))
def test_no_number_of_an_absent_servo_is_ever_sent(seed: int) -> None:
    board, client = virtual(faults=Faults(seed=seed, absent=0.5, fewer=0.2))
    with board, client() as controller:
        for _ in range(20):
            try:
                controller.hold_servos([1, 2, 3, 4])
            except AbsentError:
                continue
            there = controller.present_servos([1, 2, 3, 4])
            assert set(there) <= {1, 2, 3, 4}
        assert all(0 <= servo.position <= 1000 for servo in board.servos.values())
