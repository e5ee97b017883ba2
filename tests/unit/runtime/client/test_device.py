"""The generated device side: handlers in, reports out, and what is refused."""

from __future__ import annotations

import busservo
import pytest
from busservo import (
    ActionGroupCompleted,
    BatteryVoltage,
    BatteryVoltageRead,
    Noise,
    Reason,
    strategies,
)
from busservo.device import Device
from framegen.model.exchanges import snake_case
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn

HOST = busservo.Direction.HOST_TO_CONTROLLER
ASK, REPLY = BatteryVoltageRead().encode(), BatteryVoltage(7500).encode()


class Meter(Device):
    """A device that answers one question."""

    def on_battery_voltage_read(self, message: BatteryVoltageRead) -> BatteryVoltage:
        assert message == BatteryVoltageRead()
        return BatteryVoltage(7500)


def test_a_handler_answers_its_request_behind_reports_of_its_own_accord() -> None:
    meter = Meter()
    assert meter.receive(ASK) == REPLY
    meter.send(ActionGroupCompleted(8, 1))
    assert meter.receive(ASK) == ActionGroupCompleted(8, 1).encode() + REPLY
    assert meter.receive(b"") == b""


def test_there_is_a_handler_for_each_message_of_the_host_and_for_no_other() -> None:
    handlers = {name for name in dir(Device) if name.startswith("on_")}
    assert handlers == {
        f"on_{snake_case(kind.__name__)}" for kind in busservo.MESSAGES if kind.DIRECTION is HOST
    }
    assert {"on_servo_move", "on_action_group_run", "on_battery_voltage_read"} <= handlers
    device = Device()
    assert device.receive(ASK + busservo.ActionGroupStop().encode()) == b""
    assert device.rejects.total == 0


def test_it_sends_nothing_that_the_host_sends() -> None:
    with pytest.raises(TypeError, match="never by it"):
        Device().send(BatteryVoltageRead())  # type: ignore[arg-type]


class Listener(Device):
    """A device that keeps what it takes in."""

    def __init__(self) -> None:
        super().__init__()
        self.heard: list[busservo.Message] = []
        self.refused: list[Noise] = []

    def accepted(self, message: busservo.Message) -> None:
        self.heard.append(message)

    def rejected(self, noise: Noise) -> None:
        self.refused.append(noise)


def told(data: bytes, size: int = 1000) -> Listener:
    """Return a device that has taken in bytes, in pieces of a size."""
    device = Listener()
    for at in range(0, len(data), size):
        device.accept(data[at : at + size])
    return device


@in_turn(
    "data, reason",
    lambda: [
        ("55 55 08 03 02 E8 03 01 20 03", Reason.COUNT_MISMATCH),
        ("55 55 03 0F", Reason.LENGTH_MISMATCH),
        ("55 55 04 0F 4C 1D", Reason.LENGTH_MISMATCH),
        ("55 55 02 63", Reason.UNKNOWN_COMMAND),
        ("01 02 03", Reason.BAD_HEADER),
    ],
)
@pytest.mark.garbage
def test_what_is_refused_is_counted_once_with_its_reason(data: str, reason: Reason) -> None:
    for size in (1, 2, 100):
        device = told(bytes.fromhex(data), size)
        device.accept(ASK)
        assert device.rejects.by_reason == {reason: 1}
        assert device.rejects.total == len(device.refused) == 1


@pytest.mark.garbage
def test_a_truncated_frame_eats_what_follows_until_the_line_is_said_to_be_quiet() -> None:
    meter = Meter()
    assert meter.receive(bytes.fromhex("55 55 08 03 01")) == b""
    assert meter.receive(ASK) == b""
    meter.quiet()
    assert meter.take() == [BatteryVoltage(7500)]


def test_a_restart_forgets_half_a_frame_and_what_was_not_sent() -> None:
    meter = Meter()
    meter.accept(ASK + bytes.fromhex("55 55 08 03 01"))
    meter.restart()
    assert meter.take() == []
    assert meter.receive(ASK) == REPLY
    assert meter.rejects.total == 0


@given(st.lists(strategies.messages(HOST)), st.integers(1, 40))
def test_legal_traffic_is_never_refused_however_it_is_cut(
    messages: list[busservo.Message], size: int
) -> None:
    device = told(b"".join(message.encode() for message in messages), size)
    assert (device.heard, device.rejects.total) == (messages, 0)


@pytest.mark.garbage
def test_what_is_shown_of_what_was_refused_names_the_reasons() -> None:
    device = Device()
    assert repr(device.rejects) == "Rejects(0)"
    for wrong in ("00", "55 55 02 63", "01"):
        device.accept(bytes.fromhex(wrong) + ASK)
    assert repr(device.rejects) == "Rejects(3: bad header: 2, unknown command: 1)"
