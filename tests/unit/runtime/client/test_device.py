"""The generated device side: handlers in, reports out, and what is refused."""

from __future__ import annotations

import os
import sys

import busservo
import pytest
from busservo import (
    MESSAGES,
    ActionGroupCompleted,
    ActionGroupStop,
    BatteryVoltage,
    BatteryVoltageRead,
    Direction,
    Noise,
    Reason,
    strategies,
)
from busservo.device import Device
from framegen.model.exchanges import snake_case
from hypothesis import given
from hypothesis import strategies as st

from tests.programs import ran

HOST = Direction.HOST_TO_CONTROLLER


class Meter(Device):
    """A device that answers one question."""

    def on_battery_voltage_read(self, message: BatteryVoltageRead) -> BatteryVoltage:
        assert message == BatteryVoltageRead()
        return BatteryVoltage(7500)


def test_a_handler_answers_its_request() -> None:
    assert Meter().receive(BatteryVoltageRead().encode()) == BatteryVoltage(7500).encode()


def test_a_device_without_handlers_understands_everything_and_says_nothing() -> None:
    device = Device()
    data = BatteryVoltageRead().encode() + ActionGroupStop().encode()
    assert device.receive(data) == b""
    assert device.rejects.total == 0


def test_there_is_a_handler_for_each_message_of_the_host_and_for_no_other() -> None:
    handlers = {name for name in dir(Device) if name.startswith("on_")}
    assert handlers == {
        f"on_{snake_case(kind.__name__)}" for kind in MESSAGES if kind.DIRECTION is HOST
    }
    assert {"on_servo_move", "on_action_group_run", "on_battery_voltage_read"} <= handlers


def test_reports_of_its_own_accord_come_in_front_of_the_next_reply() -> None:
    meter = Meter()
    meter.send(ActionGroupCompleted(8, 1))
    expected = ActionGroupCompleted(8, 1).encode() + BatteryVoltage(7500).encode()
    assert meter.receive(BatteryVoltageRead().encode()) == expected
    assert meter.receive(b"") == b""


def test_it_sends_nothing_that_the_host_sends() -> None:
    with pytest.raises(TypeError, match="never by it"):
        Device().send(BatteryVoltageRead())  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        ("55 55 08 03 02 E8 03 01 20 03", Reason.COUNT_MISMATCH),
        ("55 55 03 0F", Reason.LENGTH_MISMATCH),
        ("55 55 04 0F 4C 1D", Reason.LENGTH_MISMATCH),
        ("55 55 02 63", Reason.UNKNOWN_COMMAND),
        ("01 02 03", Reason.BAD_HEADER),
    ],
)
@pytest.mark.garbage
def test_what_is_refused_is_counted_once_with_its_reason(data: str, reason: Reason) -> None:
    refused: list[Noise] = []

    class Listener(Device):
        def rejected(self, noise: Noise) -> None:
            refused.append(noise)

    for size in (1, 2, 100):
        device, refused[:] = Listener(), []
        wrong = bytes.fromhex(data)
        for at in range(0, len(wrong), size):
            device.accept(wrong[at : at + size])
        device.accept(BatteryVoltageRead().encode())
        assert device.rejects.by_reason == {reason: 1}
        assert device.rejects.total == len(refused) == 1


@pytest.mark.garbage
def test_a_truncated_frame_eats_what_follows_until_the_line_is_said_to_be_quiet() -> None:
    meter = Meter()
    assert meter.receive(bytes.fromhex("55 55 08 03 01")) == b""
    assert meter.receive(BatteryVoltageRead().encode()) == b""
    meter.quiet()
    assert meter.take() == [BatteryVoltage(7500)]


def test_a_restart_forgets_half_a_frame_and_what_was_not_sent() -> None:
    meter = Meter()
    meter.accept(BatteryVoltageRead().encode() + bytes.fromhex("55 55 08 03 01"))
    meter.restart()
    assert meter.take() == []
    assert meter.receive(BatteryVoltageRead().encode()) == BatteryVoltage(7500).encode()
    assert meter.rejects.total == 0


@given(st.lists(strategies.messages(HOST)), st.integers(1, 40))
def test_legal_traffic_is_never_refused_however_it_is_cut(
    messages: list[busservo.Message], size: int
) -> None:
    received: list[busservo.Message] = []

    class Listener(Device):
        def accepted(self, message: busservo.Message) -> None:
            received.append(message)

    device = Listener()
    data = b"".join(message.encode() for message in messages)
    for at in range(0, len(data), size):
        device.accept(data[at : at + size])
    assert received == messages
    assert device.rejects.total == 0


@given(st.lists(st.binary() | strategies.messages(HOST).map(lambda message: message.encode())))
@pytest.mark.garbage
def test_no_bytes_can_make_it_raise(chunks: list[bytes]) -> None:
    device = Meter()
    for chunk in chunks:
        device.receive(chunk)
    device.quiet()
    assert sum(device.rejects.by_reason.values()) == device.rejects.total


FRAGMENTS = (
    st.sampled_from([b"\x55", b"\x55\x55", b"\x02", b"\x0f", b"\x08\x03"])
    | st.binary(max_size=6)
    | strategies.messages(HOST).map(lambda message: message.encode())
)


@given(st.lists(FRAGMENTS, max_size=12).map(b"".join), st.integers(1, 9))
@pytest.mark.garbage
def test_how_bytes_are_cut_makes_no_difference_to_what_is_refused(data: bytes, size: int) -> None:
    def refused(pieces: list[bytes]) -> dict[Reason, int]:
        device = Device()
        for piece in pieces:
            device.accept(piece)
        device.quiet()
        return device.rejects.by_reason

    cut = [data[at : at + size] for at in range(0, len(data), size)]
    assert refused(cut) == refused([data])


def test_the_codec_alone_does_not_import_it() -> None:
    script = "import sys, busservo; print(*[name for name in sys.modules if 'device' in name])"
    search = {"PYTHONPATH": os.pathsep.join(sys.path)}
    assert ran(sys.executable, "-c", script, environment=search).stdout == "\n"


@pytest.mark.garbage
def test_what_is_shown_of_what_was_refused_names_the_reasons() -> None:
    device = Device()
    assert repr(device.rejects) == "Rejects(0)"
    for wrong in ("00", "55 55 02 63", "01"):
        device.accept(bytes.fromhex(wrong) + BatteryVoltageRead().encode())
    assert repr(device.rejects) == "Rejects(3: bad header: 2, unknown command: 1)"
