"""The line: how long bytes take, what comes of faults, echoes and rates, and that nothing fails."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from busservo import (
    BatteryVoltage,
    BatteryVoltageRead,
    Direction,
    ServoPositions,
    strategies,
)
from busservo_simulator import Board, Faults, VirtualController
from busservo_simulator.faults import CHANCES
from framewire.simulator.channel import Channel
from framewire.simulator.line import Line
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn
from tests.lines.hosts import Host

if TYPE_CHECKING:
    from collections.abc import Callable

    Connect = Callable[..., tuple[Any, Host]]
    Chunks = list[tuple[bytes, float]]

HOST = Direction.HOST_TO_CONTROLLER
VOLTAGE = BatteryVoltage(7500)
ASK, REPLY = BatteryVoltageRead().encode(), VOLTAGE.encode()
SIX = ServoPositions([(servo_id, 500) for servo_id in range(1, 7)]).encode()


def test_bytes_sent_to_an_unplugged_host_are_lost(board: VirtualController) -> None:
    line = Line(Board())
    line.cut()
    line.send(b"UU", 0.0)
    line.mend()
    assert line.read(1.0) == []
    board.unplug()
    board.send_bytes(REPLY)
    board.plug_in()
    again = Host(board.open())
    assert again.ask(BatteryVoltageRead()) == VOLTAGE
    assert again.transport.read(1.0) == b""
    assert len(board.board.event_log) == len([*board.board.event_log]) > 0


# -------------------------------------------------------------------- whatever arrives

FAULTS = st.builds(
    Faults,
    seed=st.integers(0, 99),
    **dict.fromkeys(CHANCES, st.floats(0, 0.5)) | {"hang_up": st.floats(0, 0.05)},
)
FRAMES = strategies.messages(HOST).map(lambda message: message.encode())
CHUNKS = st.lists(st.tuples(st.binary(max_size=40) | FRAMES, st.floats(0, 2)), max_size=20)
RATES = st.sampled_from([None, 300, 9601, 921600])


def carried(line: Line, chunks: Chunks, host_baud: float | None) -> list[bytes]:
    """Return what a host receives that writes these bytes, with a pause behind each."""
    line.host_baud = host_baud
    received, moment = [], 0.0
    for data, pause in chunks:
        line.write(data, moment)
        received += line.read(moment)
        moment += pause
        received += line.read(moment)
    return received + line.read(moment + 100)


@given(CHUNKS, FAULTS, st.sampled_from([None, 9600]), RATES, st.booleans())
@pytest.mark.garbage
def test_nothing_makes_the_board_fail_and_a_seed_repeats_what_comes(
    chunks: Chunks, faults: Faults, baud: float | None, host_baud: float | None, local_echo: bool
) -> None:
    given: dict[str, Any] = {"baud": baud, "local_echo": local_echo, "faults": faults}
    lines = [Line(Board(range(256)), **given) for _ in range(2)]
    once, again = (carried(line, chunks, host_baud) for line in lines)
    assert once == again
    assert lines[0].in_transit == 0


# -------------------------------------------------------------------- a host at another rate
def read_at(host_baud: float, seed: int = 0, baud: float | None = 9600) -> tuple[bytes, float]:
    """Return the bytes that a host reads of a report of six servos, and when the last has come."""
    line = Line(Board(), baud=baud)
    line.faults = Faults(seed=seed)
    line.host_baud = host_baud
    assert line.host_baud == host_baud
    line.send(SIX, 0.0)
    data, end = b"", 0.0
    while (event := line.next_event) is not None:
        end = event
        data += b"".join(line.read(event))
    return data, end


def test_garbage_takes_as_long_as_what_was_sent() -> None:
    for host_baud in (9600, 19200, 38400, 115200, 4800):
        data, end = read_at(host_baud)
        assert (data == SIX) == (host_baud == 9600)
        assert end == pytest.approx(len(SIX) / 960)
    assert read_at(115200, baud=None)[1] == 0.0


@in_turn("baud, rate", lambda: [(None, 9600), (float("inf"), 9600), (4800.0, 4800.0)])
def test_a_board_without_a_rate_has_that_of_the_protocol(baud: float | None, rate: float) -> None:
    assert Line(Board(), baud=baud).baud == rate


# -------------------------------------------------------------------- one direction of it
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


def test_nothing_takes_no_time() -> None:
    wire = Channel(10 / 9600)
    wire.put(b"", 1.0)
    assert (wire.next_event, wire.held) == (None, 0)
