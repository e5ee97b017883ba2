"""Every fault of a line: that it happens when it is chosen, and its effect; by every port."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStarted,
    BatteryVoltage,
    ServoPositions,
    ServoPositionsRead,
)
from busservo_simulator import Faults, VirtualController
from busservo_simulator.faults import CHANCES

from tests.in_turn import in_turn
from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of
from tests.timeouts import await_that
from tests.unit.runtime.simulator.conftest import ASK, STOPPED, VOLTAGE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    Faulty = Callable[..., tuple[VirtualController, Host]]

STARTED, COMPLETED = ActionGroupStarted(8, 1), ActionGroupCompleted(8, 1)


@pytest.fixture
def faulty() -> Iterator[Faulty]:
    """Yield a function that makes a board with faults, seeded alike, and its host."""
    with ExitStack() as boards:

        def make(**faults: float) -> tuple[VirtualController, Host]:
            board = boards.enter_context(virtual_board(faults=Faults(seed=7, **faults)))
            return board, host_of(board)

        yield make


def received(host: Host) -> list[Any]:
    """Return all messages that come."""
    return [*iter(host.receive, None)]


@in_turn(
    "faults, expected",
    lambda: [
        ({}, [VOLTAGE, STARTED, COMPLETED]),
        ({"dropped": 1}, [STARTED, COMPLETED]),
        ({"duplicated": 1}, [VOLTAGE, VOLTAGE, STARTED, COMPLETED]),
        ({"late": 1, "late_by": 1.0}, [STARTED, COMPLETED, VOLTAGE]),
        ({"noise": 1}, [VOLTAGE, STARTED, COMPLETED]),
    ],
)
def test_replies_have_faults_that_reports_have_not(
    faulty: Faulty, faults: dict[str, float], expected: list[Any]
) -> None:
    board, host = faulty(**faults)
    host.say(ASK)
    board.press_button(8)
    assert received(host) == expected
    frames = b"".join(each.encode() for each in expected)
    assert (host.bytes == frames) == (host.noise() == []) == ("noise" not in faults)
    assert board.accepted == 1
    board.faults = Faults()
    assert board.faults == Faults()
    assert host.ask(ASK) == VOLTAGE


@pytest.mark.garbage
@in_turn("name, refused", lambda: [("noise", 0), ("noise_to_board", 200)])
def test_noise_costs_no_frame(faulty: Faulty, name: str, refused: int) -> None:
    board, host = faulty(**{name: 1})
    assert [host.ask(ASK) for _ in range(200)] == [VOLTAGE] * 200
    assert (board.accepted, board.rejects.total) == (200, refused)
    assert bool(host.noise()) == (name == "noise")


@in_turn("chance, least, most", lambda: [(0.05, 1, 30), (1, 300, 300)])
def test_bits_are_turned_over(faulty: Faulty, chance: float, least: int, most: int) -> None:
    _board, host = faulty(bit_flips=chance)
    host.say(*[ASK] * 50)
    flips = [
        (a ^ b).bit_count() for a, b in zip(host.collect(300), VOLTAGE.encode() * 50, strict=True)
    ]
    assert {*flips} <= {0, 1}
    assert least <= sum(flips) <= most


def test_what_the_host_writes_arrives_in_two_pieces(faulty: Faulty) -> None:
    board, host = faulty(splits_to_board=1)
    assert [host.ask(ASK) for _ in range(20)] == [VOLTAGE] * 20
    assert 20 * 0.001 <= board.clock.now() <= 20 * 0.02
    host.say(ASK, ASK)
    for piece in (b"", ASK.encode()[:1], ASK.encode()[1:]):
        board.transport.write(piece)
    assert received(host) == [VOLTAGE] * 3
    assert (board.accepted, board.rejects.total) == (23, 0)


def test_frames_come_together(faulty: Faulty) -> None:
    board, host = faulty(coalesced=1)
    for asked in (3, 1):
        host.say(*[ASK] * asked)
        assert board.transport.read(1) == VOLTAGE.encode() * asked
    assert board.clock.now() == pytest.approx(0.04)


def test_a_late_reply_is_overtaken_by_what_is_sent_meanwhile(faulty: Faulty) -> None:
    board, host = faulty(late=1, late_by=1000)
    host.say(ASK)
    assert host.receive(999) is None
    board.faults = Faults()
    board.report(STOPPED)
    host.say(ServoPositionsRead([1]))
    assert received(host)[:3] == [STOPPED, ServoPositions([(1, 500)]), VOLTAGE]
    assert board.clock.now() >= 1000


@in_turn("seconds, reply", lambda: [(0.5, VOLTAGE), (1.5, None)])
def test_a_late_reply_finds_the_host_that_is_there_by_then(
    faulty: Faulty, seconds: float, reply: BatteryVoltage | None
) -> None:
    board, host = faulty(late=1, late_by=1.0)
    host.say(ASK)
    board.unplug()
    board.advance(seconds)
    board.plug_in()
    assert Host(board.open(), board.clock.now, 2).receive() == reply


def test_a_cable_that_is_put_back_is_not_cut_by_what_was_due_before(faulty: Faulty) -> None:
    board, host = faulty(hang_up=1, delays=1, longest_delay=0.5)
    host.say(ASK)
    board.advance(0.001)
    board.faults = Faults()
    board.plug_in()
    board.advance(1)
    board.transport.read(1)  # the half of the frame that was on its way
    assert host.ask(ASK) == VOLTAGE


SEEDED = {"duplicated": 0.3, "late": 0.3, "lost_bytes": 0.1, "wrong_count": 0.3}


@in_turn("name", lambda: SEEDED)
def test_a_seed_repeats_a_fault_and_another_does_not(name: str) -> None:
    def run(seed: int) -> bytes:
        with virtual_board(faults=Faults(seed, **{name: SEEDED[name]})) as board:
            host = host_of(board)
            for servo_id in range(1, 7):
                host.say(ServoPositionsRead([servo_id]))
                host.receive(0.01)
            host.receive(5)
            return host.bytes

    assert run(1) == run(1)
    assert len({run(seed) for seed in range(9)}) > 1


# -------------------------------------------------------------------- on any port

HARMFUL = {"bit_flips", "bit_flips_to_board", "dropped", "hang_up", "lost_bytes", "wrong_count"}
HARMLESS = [
    pytest.param(name, marks=[pytest.mark.garbage] * (name == "noise_to_board"))
    for name in CHANCES
    if name not in HARMFUL
]


@pytest.mark.parametrize("name", HARMLESS)
def test_a_fault_that_loses_nothing_loses_nothing(connect: Faulty, name: str) -> None:
    faults = Faults(seed=3, longest_delay=0.01, late_by=0.01, **{name: 0.5})
    board, host = connect(faults=faults)
    for _ in range(8):
        host.say(ServoPositionsRead(range(1, 7)))
        while not isinstance(heard := host.receive(), ServoPositions):
            assert heard is not None
    await_that(lambda: board.accepted == 8)
    assert bool(board.rejects.total) == (name == "noise_to_board")
