"""The other end of an addressed line, and the numbers that a client gives its frames."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import lxservo
import pytest

from tests.factories import imported, library_of
from tests.lines.servo_bus import READ_ID, READ_POSITION, frame
from tests.lines.timed_line import ScriptedLine, client_of, client_on
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(scope="module", autouse=True)
def libraries() -> Iterator[None]:
    """Return the libraries, imported under their own names."""
    with imported(*(library_of(FILES[name]) for name in ("mavlink1", "modbus"))):
        yield


def lib(name: str) -> Any:
    return importlib.import_module(name)


def servos(*addresses: int) -> Any:
    """Return a device that answers two questions, and keeps what it is called for."""

    class Servos(lxservo.Device):
        def __init__(self) -> None:
            super().__init__(*addresses)
            self.called: list[Any] = []

        def on_position_read(self, message: Any) -> Any:
            self.called.append(message)
            return lxservo.Position(message.servo_id, position=message.servo_id)

        def on_servo_id_read(self, message: Any) -> Any:
            self.called.append(message)
            for each in sorted(self.addresses) if message.servo_id == 254 else ():
                self.send(lxservo.ServoId(each, own_id=each))
            return lxservo.ServoId(message.servo_id, own_id=message.servo_id)

        def on_move(self, message: Any) -> None:
            self.called.append(message)

    return Servos()


def test_a_device_answers_only_where_its_own_address_is_called() -> None:
    device = servos(1, 2)
    assert device.receive(frame(3, READ_POSITION)) == b""
    assert device.called == []
    assert device.receive(frame(2, READ_POSITION)) == frame(2, READ_POSITION, 2, 0)
    assert device.receive(frame(1, READ_POSITION)) == frame(1, READ_POSITION, 1, 0)


def test_a_device_without_an_address_answers_to_any() -> None:
    assert servos().receive(frame(7, READ_POSITION)) == frame(7, READ_POSITION, 7, 0)


def test_what_is_for_all_is_handled_and_only_answered_by_who_says_so() -> None:
    device = servos(1, 2)
    assert device.receive(frame(254, READ_POSITION)) == b""
    assert [message.servo_id for message in device.called] == [254]
    # Its handler sends, and what it returns is not sent.
    assert device.receive(frame(254, READ_ID)) == frame(1, READ_ID, 1) + frame(2, READ_ID, 2)


def test_a_client_and_a_device_of_one_library_agree() -> None:
    with client_of(servos(1, 2)) as bus:
        assert [bus.device(each).read_position() for each in (1, 2)] == [1, 2]
        assert [each.own_id for each in bus.broadcast().read_servo_id(within=0.1)] == [1, 2]
        with pytest.raises(lxservo.NoReplyError):
            bus.read_position(3)


def test_a_handler_may_refuse() -> None:
    modbus = lib("modbus")

    class Registers(modbus.Device):  # type: ignore[misc, name-defined]
        def on_holding_read(self, message: Any) -> Any:
            if message.start:
                return modbus.HoldingReadRefused(message.unit, reason=2)
            return modbus.Holding(message.unit, registers=[7] * message.quantity)

    with client_of(Registers(17)) as bus:
        assert bus.read_holding(17, start=0, quantity=2) == (7, 7)
        with pytest.raises(modbus.RefusedError) as caught:
            bus.read_holding(17, start=1, quantity=2)
        assert caught.value.named == ("illegal_address",)


# ------------------------------------------------------------------ running numbers


def test_a_client_numbers_its_frames() -> None:
    mavlink = lib("mavlink1")
    line = ScriptedLine(lambda _: b"")
    question = mavlink.ParameterRead(
        1, index=2, target_system=1, target_component=1, name="", sequence=9
    )
    with client_on(line, mavlink.Controller, settle=None) as ground:
        for _ in range(300):
            ground.send(question)
    sent = [mavlink.decode(each, question.DIRECTION).sequence for each in line.written]
    assert sent == [each % 256 for each in range(300)]
