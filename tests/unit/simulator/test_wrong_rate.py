"""A host that is at another rate than the board: garbage arrives at either end."""

from __future__ import annotations

import select
import sys
from random import Random
from typing import TYPE_CHECKING, Any

import pytest
from busservo import (
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    Direction,
    ServoPositions,
    StreamDecoder,
    open_transport,
    strategies,
)
from busservo_simulator import Board, VirtualController
from framewire.simulator.line import Line
from framewire.simulator.uart import sampled
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.lines.hosts import Host
from tests.timeouts import await_that

if sys.platform != "win32":
    from framewire.simulator.pty_rate import read_rate, set_rate

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

needs_pty = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
# Elsewhere pyserial sets such a rate in a way that no pty takes.
on_linux = pytest.mark.skipif(sys.platform != "linux", reason="an odd rate, on a pty")
ASK = BatteryVoltageRead()
VOLTAGE = BatteryVoltage(7500)
STOPPED = ActionGroupStopped()
SIX = ServoPositions([(servo_id, 500) for servo_id in range(1, 7)])
OTHERS = [300, 1200, 2400, 4800, 14400, 19200, 38400, 57600, 115200, 921600]


def seeded(seed: int) -> Random:
    return Random(seed)  # noqa: S311 - to be repeated


# -------------------------------------------------------------------- the UART


@in_turn(
    "sent_at, read_at, read",
    lambda: [
        pytest.param(9600, 9600, "55 55 02 0f", id="the same"),
        pytest.param(9600, 9900, "55 55 02 0f", id="3 % off is read all the same"),
        pytest.param(9900, 9600, "55 55 02 0f", id="and so the other way round"),
        # 55 is 0101..., so that half of its bits at twice the rate are 0011... again and again.
        pytest.param(9600, 19200, "66 66 66 86 00 fe 80", id="a faster reader"),
        pytest.param(9600, 115200, "00 " * 13 + "00", id="each low stretch is a break"),
        pytest.param(38400, 9600, "48", id="a slower reader"),
        pytest.param(921600, 9600, "", id="too short to be a start bit"),
    ],
)
def test_a_byte_is_sampled_bit_by_bit(sent_at: int, read_at: int, read: str) -> None:
    assert sampled(ASK.encode(), sent_at, read_at, seeded(1)).hex(" ") == read


@given(st.binary(), st.floats(0.97, 1.03), st.integers())
def test_a_reader_that_is_a_little_off_reads_what_was_sent(
    data: bytes, ratio: float, seed: int
) -> None:
    assert sampled(data, 9600 * ratio, 9600, seeded(seed)) == data


@given(st.binary(max_size=60), st.sampled_from(OTHERS), st.integers())
def test_a_read_at_another_rate_is_no_longer_than_can_fit(
    data: bytes, rate: int, seed: int
) -> None:
    # A byte needs a falling edge and, until the next, ten bits of the reader's; one sent has five
    # such edges at most.
    read = sampled(data, rate, 9600, seeded(seed))
    assert len(read) <= min(5 * len(data), len(data) * 9600 / rate * 10 / 9.4 + 1)


@given(st.sampled_from(OTHERS), st.booleans(), st.data())
def test_garbage_holds_no_message(rate: int, to_board: bool, data: st.DataObject) -> None:
    direction = Direction.HOST_TO_CONTROLLER if to_board else Direction.CONTROLLER_TO_HOST
    sent = data.draw(st.lists(strategies.messages(direction), min_size=1, max_size=3))
    burst = b"".join(message.encode() for message in sent)
    for sent_at, read_at in ((rate, 9600), (9600, rate)):
        read = sampled(burst, sent_at, read_at, seeded(1))
        assert not [each for each in StreamDecoder(direction).feed(read) if each in sent]


# -------------------------------------------------------------------- the line


def carried(host_baud: float, seed: int = 0, baud: float | None = 9600) -> tuple[bytes, float]:
    """Return the bytes that a host reads of a report of six servos, and when the last has come."""
    line = Line(Board(), baud=baud)
    line.faults = type(line.faults)(seed=seed)
    line.host_baud = host_baud
    assert line.host_baud == host_baud
    line.send(SIX.encode(), 0.0)
    data, end = b"", 0.0
    while (event := line.next_event) is not None:
        end = event
        data += b"".join(line.read(event))
    return data, end


def test_garbage_takes_as_long_as_what_was_sent() -> None:
    sent = SIX.encode()
    for host_baud in (9600, 19200, 38400, 115200, 4800):
        data, end = carried(host_baud)
        assert (data == sent) == (host_baud == 9600)
        assert end == pytest.approx(len(sent) / 960)
    assert carried(115200, baud=None)[1] == 0.0


def test_the_seed_says_which_garbage() -> None:
    # Of every second bit one is looked at, at its very edge.
    assert carried(4800, seed=1) == carried(4800, seed=1)
    assert len({carried(4800, seed) for seed in range(9)}) > 1


# -------------------------------------------------------------------- the pty


@pytest.fixture(params=[None, 9600, 57600, pytest.param(96000, marks=on_linux)])
def board(request: pytest.FixtureRequest) -> Iterator[VirtualController]:
    with VirtualController("pty", baud=request.param) as board:
        yield board


def at(board: VirtualController, baud: float) -> Host:
    return Host(open_transport(board.port, baud=baud))


def right(board: VirtualController) -> float:
    return board._line.baud


@needs_pty
@pytest.mark.parametrize("baud", [1200, 19200, 115200, pytest.param(12345, marks=on_linux)])
@pytest.mark.garbage
def test_a_host_at_another_rate_receives_garbage_and_sends_garbage(
    board: VirtualController, baud: int
) -> None:
    host = at(board, baud)
    host.say(ASK, ASK)
    board.report(SIX)
    received = host.collect(1)
    assert received
    assert host.receive(0.05) is None
    assert SIX.encode() not in received + host.bytes
    await_that(lambda: not select.select([board._end._board_end], [], [], 0)[0])  # type: ignore[attr-defined]
    host.hang_up()
    host = at(board, right(board))
    assert board.accepted == 0
    host.say(ASK, ASK)  # the first may be taken for the end of what was garbage
    assert host.receive() == VOLTAGE
    host.hang_up()
    assert f"the host is at {baud} baud, the board at {right(board)}" in str(board.log)


@needs_pty
def test_a_host_that_sets_no_rate_is_at_the_right_one(board: VirtualController) -> None:
    with open(board.port, "r+b", buffering=0) as port:  # noqa: PTH123 - a device
        port.write(ASK.encode())
        assert b"".join(port.read(1) for _ in range(6)) == VOLTAGE.encode()
    assert "baud" not in str(board.log)


@needs_pty
def test_a_rate_stays_until_another_is_set(board: VirtualController) -> None:
    host = at(board, 38400)
    host.hang_up()
    board.report(STOPPED)
    await_that(lambda: "the host is at 38400 baud" in str(board.log))
    host = at(board, right(board))
    assert host.ask(ASK) == VOLTAGE
    host.hang_up()


@needs_pty
def test_a_cable_that_is_put_back_is_at_the_right_rate(tmp_path: Path) -> None:
    with VirtualController("pty", link=tmp_path / "COM7") as board:
        at(board, 38400).hang_up()
        board.unplug()
        board.plug_in()
        with open(board.port, "r+b", buffering=0) as port:  # noqa: PTH123 - a device
            port.write(ASK.encode())
            assert b"".join(port.read(1) for _ in range(6)) == VOLTAGE.encode()


@on_linux
def test_an_unknown_rate_is_taken_for_the_right_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(*_: object) -> None:
        raise OSError("no such call")

    with VirtualController("pty", baud=96000) as board:
        monkeypatch.setattr("framewire.simulator.pty_rate.fcntl.ioctl", refuse)
        assert board._end.host_baud is None
        set_rate(board._end._host_end, 12345)  # type: ignore[attr-defined]
        monkeypatch.undo()
        assert read_rate(board._end._host_end) == 96000  # type: ignore[attr-defined]


@needs_pty
def test_a_rate_kept_as_a_number_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[Any] = [0, 0, 0, 0, 12345, 12345, []]
    monkeypatch.setattr("framewire.simulator.pty_rate.sys.platform", "darwin")
    monkeypatch.setattr("framewire.simulator.pty_rate.termios.tcgetattr", lambda _end: kept)
    monkeypatch.setattr("framewire.simulator.pty_rate.termios.tcsetattr", lambda *_: None)
    assert read_rate(0) == 12345
    set_rate(0, 54321)
    assert read_rate(0) == 54321


@in_turn("via", lambda: ["memory", "tcp"])
def test_there_is_no_rate_without_a_pty(via: Any) -> None:
    with VirtualController(via) as board:
        assert board._end.host_baud is None
        transport = board.transport if via == "memory" else open_transport(board.port, baud=115200)
        host = Host(transport)
        assert host.ask(ASK) == VOLTAGE
        host.hang_up()


def test_a_board_without_a_rate_has_that_of_the_protocol() -> None:
    assert [Line(Board(), baud=baud).baud for baud in (None, float("inf"), 4800.0)] == [
        9600,
        9600,
        4800.0,
    ]
