"""Every fault: that it happens when asked for, and what it does; by every way to the board."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupStarted,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    ServoPositions,
    ServoPositionsRead,
)
from busservo.link_errors import DisconnectedError, TransportError
from busservo_simulator import Faults, VirtualClock, VirtualController
from busservo_simulator.faults import CHANCES

from tests.patience import await_that
from tests.simulator.hosts import Host, host_of

if TYPE_CHECKING:
    from collections.abc import Callable

VOLTAGE = BatteryVoltage(7500)
ASK = BatteryVoltageRead()


def faulty(**faults: float) -> VirtualController:
    """A board with faults, seeded alike."""
    clock = VirtualClock(follow_reads=True)
    return VirtualController(clock=clock, faults=Faults(seed=7, **faults))


def test_nothing_goes_wrong_unless_asked_for() -> None:
    with faulty() as board:
        host = host_of(board)
        assert [host.ask(ASK) for _ in range(50)] == [VOLTAGE] * 50
        assert host.bytes == VOLTAGE.encode() * 50


@pytest.mark.parametrize("name", CHANCES)
@pytest.mark.parametrize("chance", [-0.1, 1.1, float("nan")])
def test_a_chance_is_from_0_to_1(name: str, chance: float) -> None:
    with pytest.raises(ValueError, match=f"{name} is"):
        Faults(**{name: chance})  # type: ignore[arg-type]


def test_noise_comes_in_front_of_frames_and_costs_none() -> None:
    with faulty(noise=1) as board:
        host = host_of(board)
        assert [host.ask(ASK) for _ in range(200)] == [VOLTAGE] * 200
        assert host.noise()
        assert len(host.bytes) > 200 * len(VOLTAGE.encode())


def test_bits_are_turned_over() -> None:
    with faulty(bit_flips=0.05) as board:
        host = host_of(board)
        for _ in range(50):
            host.say(ASK)
            host.hear(0.01)
        clean = VOLTAGE.encode() * 50
        assert len(host.bytes) == len(clean)
        turned = sum((a ^ b).bit_count() for a, b in zip(host.bytes, clean, strict=True))
        assert 1 <= turned <= 30


def test_frames_come_in_two_pieces() -> None:
    with faulty(splits=1) as board:
        host = host_of(board)
        host.say(ASK)
        first, rest = board.transport.read(1), board.transport.read(1)
        assert first + rest == VOLTAGE.encode()
        assert first
        assert rest
        assert 0.001 <= board.clock.now() <= 0.02


def test_frames_come_together() -> None:
    with faulty(coalesced=1) as board:
        host = host_of(board)
        host.say(ASK, ASK, ASK)
        assert board.transport.read(1) == VOLTAGE.encode() * 3
        host.say(ASK)
        assert board.transport.read(1) == VOLTAGE.encode()
        assert board.clock.now() == pytest.approx(0.04)


def test_frames_come_late_and_in_order() -> None:
    with faulty(delays=1, longest_delay=0.2) as board:
        host = host_of(board)
        board.press_button(8)
        assert host.ask(ASK) == ActionGroupStarted(8, 1)
        assert isinstance(host.hear(), BatteryVoltage)
        assert 0 < board.clock.now() <= 0.4


def test_replies_are_dropped_and_reports_are_not() -> None:
    with faulty(dropped=1) as board:
        host = host_of(board)
        board.press_button(8)
        assert host.ask(ASK) == ActionGroupStarted(8, 1)
        assert host.hear() == ActionGroupCompleted(8, 1)
        assert board.accepted == 1


def test_servos_are_left_out_or_told_to_be_off() -> None:
    with faulty(fewer=0.3, absent=0.3) as board:
        host = host_of(board)
        counts, values = set(), set()
        for _ in range(50):
            reply = host.ask(ServoPositionsRead(range(1, 7)))
            assert isinstance(reply, ServoPositions)
            counts.add(len(reply.positions))
            values |= {position.position for position in reply.positions}
        assert len(counts) > 2
        assert values == {500, 65535}


def test_reports_come_that_nobody_asked_for() -> None:
    with faulty(unasked=1) as board:
        host = host_of(board)
        kinds = set()
        for _ in range(30):
            kinds.add(type(host.ask(ASK)))
            assert host.hear() == VOLTAGE
        assert kinds == {ActionGroupStarted, ActionGroupStopped, ActionGroupCompleted}


def test_the_line_is_cut_in_the_middle_of_a_frame() -> None:
    with faulty(hang_up=1) as board:
        host = host_of(board)
        host.say(ASK)
        assert board.transport.read(1) == VOLTAGE.encode()[:3]
        with pytest.raises(DisconnectedError):
            board.transport.read(1)
        board.faults = Faults()
        board.plug_in()
        board.open()
        assert host.ask(ASK) == VOLTAGE


def test_a_cable_that_is_put_back_is_not_cut_by_what_was_due_before() -> None:
    with faulty(hang_up=1, delays=1, longest_delay=0.5) as board:
        host = host_of(board)
        host.say(ASK)
        board.advance(0.001)
        board.faults = Faults()
        board.plug_in()
        board.advance(1)
        board.transport.read(1)  # the half of the frame that was on its way
        assert host.ask(ASK) == VOLTAGE


@pytest.mark.garbage
def test_noise_on_the_way_to_the_board_costs_no_frame() -> None:
    with faulty(noise_to_board=1) as board:
        host = host_of(board)
        assert [host.ask(ASK) for _ in range(200)] == [VOLTAGE] * 200
        assert (board.accepted, board.rejects.total) == (200, 200)


@pytest.mark.garbage
def test_bits_are_turned_over_on_the_way_to_the_board() -> None:
    with faulty(bit_flips_to_board=1) as board:
        host = host_of(board)
        host.say(ASK)
        assert host.hear(1) is None
        assert (board.accepted, board.rejects.total) == (0, 1)


def test_what_the_host_writes_arrives_in_two_pieces() -> None:
    with faulty(splits_to_board=1) as board:
        host = host_of(board)
        assert [host.ask(ASK) for _ in range(20)] == [VOLTAGE] * 20
        assert 20 * 0.001 <= board.clock.now() <= 20 * 0.02
        host.say(ASK, ASK)
        board.transport.write(b"")
        board.transport.write(ASK.encode()[:1])
        board.transport.write(ASK.encode()[1:])
        assert [host.hear() for _ in range(3)] == [VOLTAGE] * 3
        assert (board.accepted, board.rejects.total) == (23, 0)


def test_faults_can_be_set_at_any_time() -> None:
    with faulty(dropped=1) as board:
        host = host_of(board)
        assert host.ask(ASK) is None
        board.faults = Faults()
        assert board.faults == Faults()
        assert host.ask(ASK) == VOLTAGE


HARMFUL = {"bit_flips", "bit_flips_to_board", "dropped", "hang_up"}
HARMLESS = [
    pytest.param(name, marks=[pytest.mark.garbage] * (name == "noise_to_board"))
    for name in CHANCES
    if name not in HARMFUL
]


@pytest.mark.parametrize("name", HARMLESS)
def test_a_fault_that_loses_nothing_loses_nothing_on_any_port(
    connect: Callable[..., tuple[Any, Host]], name: str
) -> None:
    faults = Faults(seed=3, longest_delay=0.01, **{name: 0.5})
    board, host = connect(faults=faults)
    for _ in range(8):
        host.say(ServoPositionsRead(range(1, 7)))
        while not isinstance(host.hear(), ServoPositions):
            pass
    assert board.accepted == 8
    assert bool(board.rejects.total) == (name == "noise_to_board")


def test_a_dropped_reply_is_silence_on_any_port(connect: Callable[..., tuple[Any, Host]]) -> None:
    board, host = connect(faults=Faults(dropped=1))
    host.say(ASK)
    await_that(lambda: board.accepted == 1)
    assert host.hear(0.05) is None
    board.faults = Faults()
    assert host.ask(ASK) == VOLTAGE


def test_flipped_bits_reach_any_port(connect: Callable[..., tuple[Any, Host]]) -> None:
    _, host = connect(faults=Faults(bit_flips=1))
    host.say(ASK)
    data = host.collect(6)
    assert [(a ^ b).bit_count() for a, b in zip(data, VOLTAGE.encode(), strict=True)] == [1] * 6


def test_a_hang_up_is_an_error_on_any_port(connect: Callable[..., tuple[Any, Host]]) -> None:
    _, host = connect(faults=Faults(hang_up=1))
    host.say(ASK)
    with pytest.raises(TransportError):
        host.hear()
