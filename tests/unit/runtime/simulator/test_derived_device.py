"""The device that follows from a specification: it answers whatever protocol, and remembers."""

import importlib
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import busservo.simulator
import lxservo.simulator
import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, Controller, NoReplyError
from lxservo import Controller as Servos

from tests.factories import BUSSERVO, library, library_of
from tests.protocols.specs import FILES
from tests.rows import each_protocol

SPECS = {**FILES, "busservo": BUSSERVO}


@contextmanager
def asked(client: Any, device: Any, **settings: Any) -> Iterator[Any]:
    """Yield a client at a device, in virtual time."""
    clock = busservo.simulator.VirtualClock(follow_reads=True)
    line = busservo.simulator.VirtualLine(device, clock=clock)
    with line, client(line.transport, background=False, **settings) as opened:
        yield opened


@pytest.mark.parametrize("name", each_protocol(SPECS))
def test_each_example_of_a_request_is_answered_as_the_client_expects(name: str) -> None:
    with library(library_of(SPECS[name])) as made, warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        codec: Any = importlib.import_module(f"{made.__name__}._library").LIBRARY
        device = importlib.import_module(f"{made.__name__}.simulator").VirtualDevice()
        facts = codec.protocol()
        examples = {facts.classes[each]: said.examples for each, said in facts.messages.items()}
        with asked(codec.client, device, limits=None, retries=0) as client:
            for kind, exchange in codec.exchanges.items():
                for example in examples[kind.__name__]:
                    request = kind.decode(bytes.fromhex(example.hex))
                    if exchange.reply is None or exchange.address.silence(request):
                        client.send(request)
                    else:
                        assert type(client.request(request)) is exchange.reply
    assert [line for line in device.event_log if "has no" in line] == []


SET_AND_READ = [
    (["write_position_limits", 3, 100, 900], ["read_position_limits", 3], (3, 100, 900)),
    (["write_temperature_limit", 3, 60], ["read_temperature_limit", 3], 60),
    (["adjust_offset", 3, -20], ["read_offset", 3], -20),
    # What is set at all of them is set at each, until that one is set.
    (["write_led", 254, 1], ["read_led", 3], 1),
    # Of two commands with the fields of the reply, the one that is named most like the question.
    (["prepare_move", 3, 250, 2000], ["read_prepared_move", 3], (3, 250, 2000)),
    # Nobody has set that of another.
    (["write_torque", 2, 1], ["read_torque", 3], 0),
]


def called(client: Any, words: Sequence[Any]) -> Any:
    result = getattr(client, words[0])(*words[1:])
    return tuple(result.to_dict().values()) if hasattr(result, "to_dict") else result


@pytest.mark.parametrize(("setting", "reading", "value"), SET_AND_READ)
def test_a_reply_holds_what_was_set(setting: list[Any], reading: list[Any], value: object) -> None:
    device = lxservo.simulator.VirtualDevice(1, 2, 3)
    with asked(Servos, device) as servos:
        before = called(servos, reading)
        called(servos, setting)
        assert called(servos, reading) == value
        device.reboot(0)
        assert called(servos, reading) == before
        with pytest.raises(NoReplyError):
            servos.read_voltage(4)


def test_elements_of_a_list_are_remembered_one_by_one() -> None:
    with asked(Controller, busservo.simulator.VirtualDevice()) as controller:
        controller.move_servos({1: 700, 2: 200}, 0)
        controller.move_servos({2: 300}, 0)
        assert dict(controller.read_servo_positions([2, 1])) == {2: 300, 1: 700}


def test_what_is_written_by_hand_takes_the_place_of_what_is_derived() -> None:
    class Board(busservo.simulator.VirtualDevice):
        def on_battery_voltage_read(self, message: BatteryVoltageRead) -> BatteryVoltage | None:
            derived = self.answer(message)
            assert isinstance(derived, BatteryVoltage)
            return BatteryVoltage(derived.voltage_mv + 1)

    with (
        asked(Controller, Board()) as board,
        asked(Controller, busservo.simulator.VirtualDevice()) as derived,
    ):
        assert board.read_battery_voltage() == derived.read_battery_voltage() + 1


def test_what_nobody_asks_for_is_sent_in_turn_every_so_often() -> None:
    with library(library_of(SPECS["crsf"])) as made:
        device = importlib.import_module(f"{made.__name__}.simulator").VirtualDevice()
        kinds = [kind.__name__ for kind in device.unasked]
        device.advance_to(100.0)
        assert device.take() == []
        device.every = 0.5
        device.advance_to(101.4)
        assert [type(each).__name__ for each in device.take()] == [*kinds, *kinds][:3]
        assert device.next_event == 101.5
