"""A frame with a gap is no frame: what a gap ends, and what it does not."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from busservo import (
    ActionGroupCompleted,
    BatteryVoltage,
    BatteryVoltageRead,
    Controller,
    NoReplyError,
    ServoPositionsRead,
)
from framewire.codec.gap import GAP

from tests.in_turn import in_turn
from tests.lines.questions import ask
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.unit.runtime.client.test_possible_replies import session

if TYPE_CHECKING:
    from pathlib import Path

TORN = BatteryVoltage(0x1D4C).encode()[:4]
REPORT = ActionGroupCompleted(8, 1)


@in_turn("gap", lambda: [0.0, 0.001, 0.005, 0.03, 0.049, 0.06, 0.1, 0.2])
def test_a_hole_and_a_report_after_any_time_are_an_error_and_that_report(gap: float) -> None:
    line = VirtualLine(lambda message: [(0.015, TORN), (gap, REPORT)] if _asks(message) else [])
    with client_on(line, Controller) as controller:
        with pytest.raises(NoReplyError, match="4 bytes came that are no frame"):
            controller.read_battery_voltage()
        assert list(controller.reports(timeout=1)) == [REPORT]


def _asks(message: object) -> bool:
    return isinstance(message, BatteryVoltageRead)


def test_a_gap_counts_only_where_the_port_was_found_empty() -> None:
    """A process that is stopped in the middle of a reply finds the rest of it afterwards."""
    line = session()
    request = ask(line, 0.0)
    frame = BatteryVoltage(7500).encode()
    line.receive(frame[:4], 0.01)
    line.tick(0.005)
    # A second later: the next read finds bytes at once, so nobody knows when they came.
    line.receive(frame[4:], 1.01)
    line.tick(1.005)
    assert request.reply == BatteryVoltage(7500)


@in_turn("empty_at, ends", lambda: [(0.049, False), (0.051, True)])
def test_a_port_found_empty_for_longer_than_the_gap_ends_a_frame(
    empty_at: float, ends: bool
) -> None:
    line = session()
    request = ask(line, 0.0)
    frame = BatteryVoltage(7500).encode()
    line.receive(frame[:4], 0.01)
    line.tick(0.01 + empty_at)
    line.receive(frame[4:], 0.09)
    assert (request.reply is None) is ends
    assert line.counters.noise == (len(frame) if ends else 0)


def test_the_next_tick_is_due_when_a_gap_is_over() -> None:
    line = session()
    line.receive(TORN, 1.0)
    assert line.tick_at == pytest.approx(1.0 + GAP)
    line.tick(1.0 + GAP)
    assert line.tick_at is None
    assert line.counters.noise == len(TORN)


def test_a_reply_that_may_be_torn_waits_until_the_line_is_quiet_and_no_longer() -> None:
    line = session()
    request = ask(line, 0.0)
    line.receive(BatteryVoltage(0x5555).encode(), 0.02)
    assert not request.done
    line.tick(0.02 + GAP)
    assert request.reply == BatteryVoltage(0x5555)


def test_a_reply_that_may_be_torn_is_as_old_as_its_bytes() -> None:
    """Held until the line is quiet, it is still sooner than the wire allows."""
    line = session()
    request = ask(line, 0.0, ServoPositionsRead([1]))
    line.receive(bytes.fromhex("55 55 06 15 01 01 55 55"), 0.001)
    line.tick(0.001 + GAP)
    assert not request.done
    assert line.counters.impossible == 1


def test_a_reply_under_way_when_the_time_is_up_may_arrive_in_full() -> None:
    line = session()
    request = ask(line, 0.0)
    assert line.tick_at is not None
    expires = line.tick_at
    frame = BatteryVoltage(7500).encode()
    line.receive(frame[:3], expires - 0.001)
    line.tick(expires)
    line.receive(frame[3:], expires + 0.003)
    assert request.reply == BatteryVoltage(7500)


def test_a_line_that_never_falls_silent_does_not_keep_a_question_for_ever() -> None:
    line = session()
    request = ask(line, 0.0)
    now = 0.0
    while not request.done:
        now += 0.04
        assert now < 1.0
        line.receive(b"\x55\x55", now)
        line.tick(now)
    assert isinstance(request.error, NoReplyError)


def test_a_frame_that_breaks_off_is_marked_in_the_trace(tmp_path: Path) -> None:
    line = VirtualLine(lambda _: [(0.0, b"\x55\x55\x04")])
    trace = tmp_path / "line.log"
    with (
        client_on(line, Controller, trace=trace) as controller,
        pytest.raises(NoReplyError),
    ):
        controller.read_battery_voltage()
    assert "# quiet" in trace.read_text(encoding="utf-8")


def test_a_reply_behind_a_false_header_is_found_in_time_though_the_line_is_never_quiet() -> None:
    line = session()
    request = ask(line, 0.0)
    # What claims to be positions of 84 servos; the voltage is in the middle of it.
    line.receive(b"\x55\x55\xff\x15\x54" + BatteryVoltage(7500).encode(), 0.02)
    for step in range(3, 16):
        line.tick(step / 50)
        line.receive(b"\x00", step / 50)
    assert not request.done
    line.tick(0.25 + 10 / 960 + GAP)
    assert request.reply == BatteryVoltage(7500)
    assert line.counters.timeouts == 0
