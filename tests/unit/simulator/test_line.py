"""The line: how long bytes take, by a clock that needs no sleep; and a clock that stands still."""

from __future__ import annotations

import threading
import time

import pytest
from busservo import (
    ActionGroupStarted,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    Direction,
    Message,
    ServoMove,
    ServoPositionsRead,
    strategies,
)
from busservo_simulator import Board, Faults, VirtualClock, VirtualController
from busservo_simulator.faults import CHANCES
from framewire.line.link_errors import ClosedError, DisconnectedError, PortNotFoundError
from framewire.simulator.channel import Channel
from framewire.simulator.line import Line
from hypothesis import given
from hypothesis import strategies as st

from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of
from tests.timeouts import GENEROUS

HOST = Direction.HOST_TO_CONTROLLER


def test_a_wire_carries_a_byte_in_ten_bits() -> None:
    wire = Channel(10 / 9600)
    wire.put(b"abc", 1.0)
    wire.put(b"d", 1.0)
    assert wire.take(1.0 + 10 / 9600) == [b"a"]
    assert wire.held == 3
    assert wire.take(1.0 + 40 / 9600) == [b"bcd"]
    assert wire.next_event is None


def test_a_wire_without_a_rate_keeps_pieces_apart() -> None:
    wire = Channel()
    wire.put(b"abc", 1.0)
    wire.put(b"d", 1.0)
    assert wire.take(0.9) == []
    assert wire.take(1.0) == [b"abc", b"d"]


def test_reading_six_servos_takes_as_long_as_the_wire_needs() -> None:
    with virtual_board(baud=9600) as board:
        host = host_of(board)
        for _ in range(100):
            assert host.ask(ServoPositionsRead(range(1, 7)))
        assert board.clock.now() == pytest.approx(100 * 34 / 960)


def test_commands_queue_on_the_wire_and_drain_waits_for_them() -> None:
    with virtual_board(baud=9600) as board:
        move = ServoMove(100, [(1, 600)])
        for _ in range(10):
            board.transport.write(move.encode())
        assert board.accepted == 0
        board.transport.drain(0.05)
        assert board.clock.now() == pytest.approx(0.05)
        board.transport.drain(10)
        assert board.clock.now() == pytest.approx(100 / 960)
        assert board.accepted == 10


def test_time_stands_still_until_it_is_moved_on() -> None:
    with VirtualController(clock=VirtualClock()) as board:
        host = Host(board.transport)
        host.say(ServoMove(1000, [(1, 900)]))
        assert host.receive(0.01) is None
        assert board.servos[1].position == 500
        board.advance(0.25)
        assert board.servos[1].position == 600


def test_time_does_not_go_back() -> None:
    with pytest.raises(ValueError, match="not by -1"):
        VirtualClock().advance(-1)


def test_real_time_cannot_be_moved() -> None:
    with VirtualController() as board, pytest.raises(TypeError, match="VirtualClock"):
        board.advance(1)


def test_a_read_in_another_thread_gets_a_report_at_once() -> None:
    with VirtualController() as board:
        received: list[Message | None] = []
        host = Host(board.transport)
        reader = threading.Thread(target=lambda: received.append(host.receive()))
        reader.start()
        board.report(ActionGroupStopped())
        reader.join(GENEROUS)
        assert received == [ActionGroupStopped()]


def test_a_read_without_bytes_ends_in_time() -> None:
    with VirtualController() as board:
        begun = time.monotonic()
        assert board.transport.read(0.02) == b""
        assert 0.02 <= time.monotonic() - begun < GENEROUS


def test_closing_ends_a_read_in_another_thread() -> None:
    with VirtualController() as board:
        failed: list[Exception] = []

        def read() -> None:
            try:
                board.transport.read(2 * GENEROUS)
            except ClosedError as error:
                failed.append(error)

        reader = threading.Thread(target=read)
        reader.start()
        board.transport.close()
        reader.join(GENEROUS)
        assert not reader.is_alive()
        assert len(failed) == 1
        with pytest.raises(ClosedError):
            board.transport.write(b"")
        board.open().write(BatteryVoltageRead().encode())
        assert Host(board.transport).receive() == BatteryVoltage(7500)


def test_an_unplugged_board_is_an_error_until_it_is_plugged_in(
    board: VirtualController, host: Host
) -> None:
    host.say(BatteryVoltageRead())
    board.unplug()
    assert board.transport.read(0) == BatteryVoltage(7500).encode()
    with pytest.raises(DisconnectedError):
        board.transport.read(1)
    with pytest.raises(DisconnectedError):
        host.say(BatteryVoltageRead())
    with pytest.raises(PortNotFoundError):
        board.open()
    board.plug_in()
    board.open()
    assert host.ask(BatteryVoltageRead()) == BatteryVoltage(7500)


def test_a_board_elsewhere_has_no_transport_here() -> None:
    with VirtualController("tcp") as board, pytest.raises(ValueError, match="open that"):
        _ = board.transport


def test_there_are_three_ways_to_a_board() -> None:
    with pytest.raises(ValueError, match="'memory', 'pty' or 'tcp'"):
        VirtualController("usb")  # type: ignore[arg-type]


def test_a_board_with_spurious_output_takes_no_input(board: VirtualController, host: Host) -> None:
    board.spurious_output(b"\x55", per_second=100)
    host.say(BatteryVoltageRead())
    assert host.receive(1.0) is None
    assert set(host.bytes) == {0x55}
    assert len(host.bytes) == pytest.approx(100, abs=2)
    board.spurious_output(None)
    assert board.accepted == 0
    assert host.ask(BatteryVoltageRead()) == BatteryVoltage(7500)


def test_a_board_that_floods_reports_still_answers(board: VirtualController, host: Host) -> None:
    board.spurious_output(ActionGroupStarted(8, 1).encode(), per_second=1000, ignore_input=False)
    host.say(BatteryVoltageRead())
    received = [host.receive() for _ in range(50)]
    assert received.count(BatteryVoltage(7500)) == 1
    assert received.count(ActionGroupStarted(8, 1)) == 49


def test_raw_bytes_can_be_sent(board: VirtualController, host: Host) -> None:
    board.send_bytes(b"\x55\x55\x04")
    board.send_bytes(b"\x0f\x4c\x1d")
    assert host.receive() == BatteryVoltage(7500)


CHANCE = st.floats(0, 0.5)
FAULTS = st.builds(
    Faults,
    seed=st.integers(0, 99),
    **dict.fromkeys(CHANCES, CHANCE) | {"hang_up": st.floats(0, 0.05)},
)
CHUNKS = st.lists(
    st.tuples(
        st.binary(max_size=40) | strategies.messages(HOST).map(lambda message: message.encode()),
        st.floats(0, 2),
    ),
    max_size=20,
)


RATES = st.sampled_from([None, 300, 9601, 921600])


@given(CHUNKS, FAULTS, st.sampled_from([None, 9600]), RATES, st.booleans())
@pytest.mark.garbage
def test_nothing_that_arrives_can_make_the_board_fail(
    chunks: list[tuple[bytes, float]],
    faults: Faults,
    baud: float | None,
    host_baud: float | None,
    local_echo: bool,
) -> None:
    line = Line(Board(range(256)), baud=baud, local_echo=local_echo, faults=faults)
    line.host_baud = host_baud
    moment = 0.0
    for data, pause in chunks:
        line.write(data, moment)
        line.read(moment)
        moment += pause
    line.read(moment + 100)
    assert line.in_transit == 0


@given(CHUNKS, FAULTS, RATES)
@pytest.mark.garbage
def test_the_same_seed_and_the_same_traffic_give_the_same_bytes(
    chunks: list[tuple[bytes, float]], faults: Faults, host_baud: float | None
) -> None:
    def run() -> list[bytes]:
        line, moment = Line(Board(), faults=faults), 0.0
        line.host_baud = host_baud
        received: list[bytes] = []
        for data, pause in chunks:
            line.write(data, moment)
            moment += pause
            received += line.read(moment)
        return received + line.read(moment + 10)

    assert run() == run()


@given(st.lists(strategies.messages(HOST)), st.integers(1, 40), st.booleans())
def test_legal_traffic_is_never_refused(messages: list[Message], size: int, slow: bool) -> None:
    line = Line(Board(), baud=9600 if slow else None)
    data = b"".join(message.encode() for message in messages)
    for at in range(0, len(data), size):
        line.write(data[at : at + size], 0.0)
    line.read(len(data) / 960 + 1)
    assert line.board.heard == len(messages)
    assert line.board.rejects.total == 0


@pytest.mark.garbage
@given(st.lists(strategies.messages(HOST)), st.integers(0, 99))
def test_no_noise_on_the_way_to_the_board_costs_a_frame(messages: list[Message], seed: int) -> None:
    faults = Faults(seed=seed, noise_to_board=0.5, splits_to_board=0.5)
    line = Line(Board(), faults=faults)
    for message in messages:
        line.write(message.encode(), 0.0)
    line.read(len(messages) + 1)
    assert line.board.heard == len(messages)


@given(strategies.messages(HOST), st.floats(0, 5), st.integers(1, 10))
def test_how_often_one_looks_makes_no_difference(
    message: Message, until: float, looks: int
) -> None:
    def run(moments: list[float]) -> tuple[bytes, list[int], int]:
        board = Board()
        line = Line(board)
        line.write(message.encode(), 0.0)
        data = b"".join(piece for moment in moments for piece in line.read(moment))
        return data, [servo.position for servo in board.servos.values()], board.battery.voltage_mv

    once = run([until])
    often = run([until * look / looks for look in range(looks)] + [until])
    assert once == often


def test_bytes_sent_to_an_unplugged_host_are_lost(board: VirtualController, host: Host) -> None:
    line = Line(Board())
    line.cut()
    line.send(b"UU", 0.0)
    line.mend()
    assert line.read(1.0) == []
    board.unplug()
    board.send_bytes(BatteryVoltage(7500).encode())
    board.plug_in()
    again = Host(board.open())
    assert again.ask(BatteryVoltageRead()) == BatteryVoltage(7500)
    assert again.transport.read(1.0) == b""
    assert len(board.board.event_log) == len([*board.board.event_log]) > 0


def test_an_empty_write_takes_no_time() -> None:
    wire = Channel(10 / 9600)
    wire.put(b"", 1.0)
    assert (wire.next_event, wire.held) == (None, 0)
