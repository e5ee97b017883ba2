"""Every fault: that it happens when it is chosen, and its effect; by every kind of port."""

from __future__ import annotations

from contextlib import contextmanager
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
from busservo_simulator import Faults, VirtualController
from busservo_simulator.faults import CHANCES, DURATIONS
from framewire.line.link_errors import DisconnectedError, TransportError

from tests.in_turn import in_turn
from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of
from tests.timeouts import await_that

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

VOLTAGE = BatteryVoltage(7500)
ASK = BatteryVoltageRead()


@contextmanager
def faulty(**faults: float) -> Iterator[tuple[VirtualController, Host]]:
    """Yield a board with faults, seeded alike, and its host."""
    with virtual_board(faults=Faults(seed=7, **faults)) as board:
        yield board, host_of(board)


def test_there_are_no_faults_by_default() -> None:
    with faulty() as (_board, host):
        assert [host.ask(ASK) for _ in range(50)] == [VOLTAGE] * 50
        assert host.bytes == VOLTAGE.encode() * 50


@in_turn("name", lambda: CHANCES)
@in_turn("chance", lambda: [-0.1, 1.1, float("nan")])
def test_a_chance_is_from_0_to_1(name: str, chance: float) -> None:
    with pytest.raises(ValueError, match=f"{name} is"):
        Faults(**{name: chance})  # type: ignore[arg-type]


@in_turn("name", lambda: DURATIONS)
@in_turn("seconds", lambda: [-0.1, float("inf"), float("nan")])
def test_seconds_are_0_or_more(name: str, seconds: float) -> None:
    with pytest.raises(ValueError, match=f"{name} is"):
        Faults(**{name: seconds})  # type: ignore[arg-type]


def test_noise_comes_in_front_of_frames_and_costs_none() -> None:
    with faulty(noise=1) as (_board, host):
        assert [host.ask(ASK) for _ in range(200)] == [VOLTAGE] * 200
        assert host.noise()
        assert len(host.bytes) > 200 * len(VOLTAGE.encode())


def test_bits_are_turned_over() -> None:
    with faulty(bit_flips=0.05) as (_board, host):
        for _ in range(50):
            host.say(ASK)
            host.receive(0.01)
        clean = VOLTAGE.encode() * 50
        assert len(host.bytes) == len(clean)
        turned = sum((a ^ b).bit_count() for a, b in zip(host.bytes, clean, strict=True))
        assert 1 <= turned <= 30


def test_frames_come_in_two_pieces() -> None:
    with faulty(splits=1) as (board, host):
        host.say(ASK)
        first, rest = board.transport.read(1), board.transport.read(1)
        assert first + rest == VOLTAGE.encode()
        assert first
        assert rest
        assert 0.001 <= board.clock.now() <= 0.02


def test_frames_come_together() -> None:
    with faulty(coalesced=1) as (board, host):
        host.say(ASK, ASK, ASK)
        assert board.transport.read(1) == VOLTAGE.encode() * 3
        host.say(ASK)
        assert board.transport.read(1) == VOLTAGE.encode()
        assert board.clock.now() == pytest.approx(0.04)


def test_frames_come_late_and_in_order() -> None:
    with faulty(delays=1, longest_delay=0.2) as (board, host):
        board.press_button(8)
        assert host.ask(ASK) == ActionGroupStarted(8, 1)
        assert isinstance(host.receive(), BatteryVoltage)
        assert 0 < board.clock.now() <= 0.4


def test_a_late_reply_is_overtaken_by_what_is_sent_meanwhile() -> None:
    with faulty(late=1, late_by=1000) as (board, host):
        host.say(ASK)
        assert host.receive(999) is None
        board.faults = Faults()
        board.report(ActionGroupStopped())
        assert host.ask(ServoPositionsRead([1])) == ActionGroupStopped()
        assert host.receive() == ServoPositions([(1, 500)])
        assert host.receive() == VOLTAGE
        assert board.clock.now() == pytest.approx(1000)


def test_late_replies_come_in_order_and_whole() -> None:
    with virtual_board(baud=9600) as board:
        board.faults = Faults(late=1, late_by=0.05)
        host = host_of(board)
        for servo_id in range(1, 7):
            host.say(ServoPositionsRead([servo_id]))
        received = [host.receive() for _ in range(6)]
        assert received == [ServoPositions([(servo_id, 500)]) for servo_id in range(1, 7)]
        assert host.noise() == []


def test_a_late_reply_finds_the_host_that_is_there_by_then() -> None:
    with faulty(late=1, late_by=1.0) as (board, host):
        host.say(ASK)
        board.unplug()
        board.advance(0.5)
        board.plug_in()
        assert Host(board.open(), board.clock.now, 2).receive() == VOLTAGE
        host.say(ASK)
        board.unplug()
        board.advance(1.5)
        board.plug_in()
        assert Host(board.open(), board.clock.now, 2).receive() is None


def test_a_board_that_restarts_forgets_its_late_replies() -> None:
    with faulty(late=1, coalesced=1) as (board, host):
        host.say(ASK)
        board.reboot(0.1)
        assert host.receive() is None


def test_a_reply_comes_twice_and_a_report_once() -> None:
    with faulty(duplicated=1) as (board, host):
        assert host.ask(ASK) == VOLTAGE
        assert host.receive() == VOLTAGE
        board.press_button(8)
        assert host.receive() == ActionGroupStarted(8, 1)
        assert host.receive() == ActionGroupCompleted(8, 1)
        assert host.receive() is None


def test_bytes_are_lost() -> None:
    clean = VOLTAGE.encode()
    with faulty(lost_bytes=0.1) as (board, host):
        sizes = []
        for _ in range(50):
            host.say(ASK)
            frame = board.transport.read(0.01)
            rest = iter(clean)
            assert all(byte in rest for byte in frame)  # what is left is in order
            sizes.append(len(frame))
        assert 10 <= sum(6 - size for size in sizes) <= 60
        assert sizes.count(6) > sizes.count(5) > 0


def test_a_reply_counts_one_too_many_or_too_few() -> None:
    with faulty(wrong_count=1) as (board, host):
        frames = set()
        for _ in range(20):
            host.say(ServoPositionsRead([1, 2]))
            frames.add(board.transport.read(1).hex(" "))
        assert frames == {f"55 55 09 15 {count} 01 f4 01 02 f4 01" for count in ("01", "03")}
        assert host.ask(ASK) == VOLTAGE  # it has no count


def test_replies_are_dropped_and_reports_are_not() -> None:
    with faulty(dropped=1) as (board, host):
        board.press_button(8)
        assert host.ask(ASK) == ActionGroupStarted(8, 1)
        assert host.receive() == ActionGroupCompleted(8, 1)
        assert board.accepted == 1


def test_servos_are_left_out_or_reported_to_be_off() -> None:
    with faulty(fewer=0.3, absent=0.3) as (_board, host):
        counts, values = set(), set()
        for _ in range(50):
            reply = host.ask(ServoPositionsRead(range(1, 7)))
            assert isinstance(reply, ServoPositions)
            counts.add(len(reply.positions))
            values |= {position.position for position in reply.positions}
        assert len(counts) > 2
        assert values == {500, 65535}


def test_unsolicited_reports_are_sent() -> None:
    with faulty(unsolicited=1) as (_board, host):
        kinds = set()
        for _ in range(30):
            kinds.add(type(host.ask(ASK)))
            assert host.receive() == VOLTAGE
        assert kinds == {ActionGroupStarted, ActionGroupStopped, ActionGroupCompleted}


def test_the_line_is_cut_in_the_middle_of_a_frame() -> None:
    with faulty(hang_up=1) as (board, host):
        host.say(ASK)
        assert board.transport.read(1) == VOLTAGE.encode()[:3]
        with pytest.raises(DisconnectedError):
            board.transport.read(1)
        board.faults = Faults()
        board.plug_in()
        board.open()
        assert host.ask(ASK) == VOLTAGE


def test_a_cable_that_is_put_back_is_not_cut_by_what_was_due_before() -> None:
    with faulty(hang_up=1, delays=1, longest_delay=0.5) as (board, host):
        host.say(ASK)
        board.advance(0.001)
        board.faults = Faults()
        board.plug_in()
        board.advance(1)
        board.transport.read(1)  # the half of the frame that was on its way
        assert host.ask(ASK) == VOLTAGE


@pytest.mark.garbage
def test_noise_on_the_way_to_the_board_costs_no_frame() -> None:
    with faulty(noise_to_board=1) as (board, host):
        assert [host.ask(ASK) for _ in range(200)] == [VOLTAGE] * 200
        assert (board.accepted, board.rejects.total) == (200, 200)


@pytest.mark.garbage
def test_bits_are_turned_over_on_the_way_to_the_board() -> None:
    with faulty(bit_flips_to_board=1) as (board, host):
        host.say(ASK)
        assert host.receive(1) is None
        assert (board.accepted, board.rejects.total) == (0, 1)


def test_what_the_host_writes_arrives_in_two_pieces() -> None:
    with faulty(splits_to_board=1) as (board, host):
        assert [host.ask(ASK) for _ in range(20)] == [VOLTAGE] * 20
        assert 20 * 0.001 <= board.clock.now() <= 20 * 0.02
        host.say(ASK, ASK)
        board.transport.write(b"")
        board.transport.write(ASK.encode()[:1])
        board.transport.write(ASK.encode()[1:])
        assert [host.receive() for _ in range(3)] == [VOLTAGE] * 3
        assert (board.accepted, board.rejects.total) == (23, 0)


def test_faults_can_be_set_at_any_time() -> None:
    with faulty(dropped=1) as (board, host):
        assert host.ask(ASK) is None
        board.faults = Faults()
        assert board.faults == Faults()
        assert host.ask(ASK) == VOLTAGE


NEW = {"duplicated": 0.3, "late": 0.3, "lost_bytes": 0.1, "wrong_count": 0.3}


@in_turn("name", lambda: NEW)
def test_a_seed_repeats_a_fault_and_another_does_not(name: str) -> None:
    def run(seed: int) -> bytes:
        with virtual_board(faults=Faults(seed, **{name: NEW[name]})) as board:
            host = host_of(board)
            for servo_id in range(1, 7):
                host.say(ServoPositionsRead([servo_id]))
                host.receive(0.01)
            host.receive(5)
            return host.bytes

    assert run(1) == run(1)
    assert len({run(seed) for seed in range(9)}) > 1


HARMFUL = {"bit_flips", "bit_flips_to_board", "dropped", "hang_up", "lost_bytes", "wrong_count"}
HARMLESS = [
    pytest.param(name, marks=[pytest.mark.garbage] * (name == "noise_to_board"))
    for name in CHANCES
    if name not in HARMFUL
]


@pytest.mark.parametrize("name", HARMLESS)
def test_a_fault_that_loses_nothing_loses_nothing_on_any_port(
    connect: Callable[..., tuple[Any, Host]], name: str
) -> None:
    faults = Faults(seed=3, longest_delay=0.01, late_by=0.01, **{name: 0.5})
    board, host = connect(faults=faults)
    for _ in range(8):
        host.say(ServoPositionsRead(range(1, 7)))
        while not isinstance(received := host.receive(), ServoPositions):
            assert received is not None
    await_that(lambda: board.accepted == 8)
    assert bool(board.rejects.total) == (name == "noise_to_board")


def test_a_dropped_reply_is_silence_on_any_port(connect: Callable[..., tuple[Any, Host]]) -> None:
    board, host = connect(faults=Faults(dropped=1))
    host.say(ASK)
    await_that(lambda: board.accepted == 1)
    assert host.receive(0.05) is None
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
        host.receive()
