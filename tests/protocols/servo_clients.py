"""Clients of the LX-16A servo bus, from the package index.

They are `lewansoul-lx16a` and `pylx16a`.
"""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest

from tests.protocols.peer import Peer, Values, as_is, with_values
from tests.protocols.specs import messages_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

# What tells a servo something, and what asks it; a client, the servo, and values by their names.
Tell: TypeAlias = "Callable[[Any, int, Values], object]"
Ask: TypeAlias = "Callable[[Any, int], Values]"


@dataclass
class Wire:
    """A line for clients that write and read: `reply` comes back to whatever is written."""

    reply: bytes = b""
    timeout: float | None = None
    written: bytes = b""
    waiting: bytes = field(default=b"", repr=False)

    def write(self, data: bytes) -> int:
        """Take what is written, and have the reply ready."""
        self.written, self.waiting = bytes(data), self.reply
        return len(data)

    def read(self, size: int = 1) -> bytes:
        """Return what has come."""
        found, self.waiting = self.waiting[:size], self.waiting[size:]
        return found

    def reset_input_buffer(self) -> None:
        """Forget what has come."""
        self.waiting = b""


def _to_one(values: Values) -> Values:
    """Return the values, from a single servo."""
    return values | {"servo_id": min(values["servo_id"], 253)}


def _mode(values: Values) -> Values:
    """Return values with a speed for a motor alone: clients tell no other."""
    mode = values["mode"] & 1
    return values | {"mode": mode, "speed": values["speed"] if mode else 0}


_TORQUE = with_values(torque=lambda value: value & 1)
_LED = with_values(led=lambda value: value & 1)


# --- lewansoul-lx16a -----------------------------------------------------------------------------

_TELLS: dict[str, Tell] = {
    "Move": lambda servos, to, told: servos.move(to, told["position"], told["time_ms"]),
    "MovePrepare": lambda servos, to, told: servos.move_prepare(
        to, told["position"], told["time_ms"]
    ),
    "MoveStart": lambda servos, to, _: servos.move_start(to),
    "MoveStop": lambda servos, to, _: servos.move_stop(to),
    "ServoIdWrite": lambda servos, to, told: servos.set_servo_id(to, told["new_id"]),
    "OffsetAdjust": lambda servos, to, told: servos.set_position_offset(to, told["offset"]),
    "OffsetSave": lambda servos, to, _: servos.save_position_offset(to),
    "PositionLimitsWrite": lambda servos, to, told: servos.set_position_limits(
        to, told["lowest"], told["highest"]
    ),
    "VoltageLimitsWrite": lambda servos, to, told: servos.set_voltage_limits(
        to, told["lowest_mv"], told["highest_mv"]
    ),
    "TemperatureLimitWrite": lambda servos, to, told: servos.set_max_temperature_limit(
        to, told["highest"]
    ),
    "ModeWrite": lambda servos, to, told: (
        servos.set_motor_mode(to, told["speed"]) if told["mode"] else servos.set_servo_mode(to)
    ),
    "TorqueWrite": lambda servos, to, told: (
        servos.motor_on(to) if told["torque"] else servos.motor_off(to)
    ),
    "LedWrite": lambda servos, to, told: servos.led_off(to) if told["led"] else servos.led_on(to),
    "LedErrorsWrite": lambda servos, to, told: servos.set_led_errors(to, told["errors"]),
}
# By the message that replies.
_ASKS: dict[str, Ask] = {
    "PreparedMove": lambda servos, to: _two("position", "time_ms", servos.get_prepared_move(to)),
    "ServoId": lambda servos, to: {"own_id": servos.get_servo_id(to)},
    "Offset": lambda servos, to: {"offset": servos.get_position_offset(to)},
    "PositionLimits": lambda servos, to: _two("lowest", "highest", servos.get_position_limits(to)),
    "VoltageLimits": lambda servos, to: _two(
        "lowest_mv", "highest_mv", servos.get_voltage_limits(to)
    ),
    "TemperatureLimit": lambda servos, to: {"highest": servos.get_max_temperature_limit(to)},
    "Temperature": lambda servos, to: {"temperature": servos.get_temperature(to)},
    "Voltage": lambda servos, to: {"voltage_mv": servos.get_voltage(to)},
    "Position": lambda servos, to: {"position": servos.get_position(to)},
    "Mode": lambda servos, to: {
        "mode": servos.get_mode(to),
        "speed": servos.get_motor_speed(to),
    },
    "Torque": lambda servos, to: {"torque": int(servos.is_motor_on(to))},
    "Led": lambda servos, to: {"led": 1 - servos.is_led_on(to)},
    "LedErrors": lambda servos, to: {"errors": servos.get_led_errors(to)},
}


def _two(first: str, second: str, values: Iterable[object]) -> Values:
    return dict(zip((first, second), values, strict=True))


def _questions() -> dict[str, str]:
    """Return the messages to which there is a reply, with the reply."""
    messages = messages_of("lxservo").values()
    return {each.name: str(each.message.reply) for each in messages if each.message.reply}


class LewansoulLx16a(Peer):
    """The client `lewansoul-lx16a`."""

    protocol = "lxservo"
    package = "lewansoul_lx16a"
    writes = (
        dict.fromkeys(_TELLS, as_is)
        | {name: as_is for name, reply in _questions().items() if reply in _ASKS}
        | {"ModeWrite": _mode}
    )
    reads = dict.fromkeys(_ASKS, _to_one) | {
        "Mode": lambda values: _to_one(_mode(values)),
        "Torque": lambda values: _to_one(_TORQUE(values)),
        "Led": lambda values: _to_one(_LED(values)),
    }

    def __init__(self) -> None:
        super().__init__()
        self.wire = Wire()
        self.servos = self.module.ServoController(self.wire, timeout=0.001)

    def write(self, message: str, values: Values) -> bytes:
        to = values["servo_id"]
        if message in _TELLS:
            _TELLS[message](self.servos, to, values)
        else:
            with pytest.raises(self.module.TimeoutError):
                _ASKS[_questions()[message]](self.servos, to)
        return self.wire.written

    def read(self, message: str, frame: bytes) -> Values:
        self.wire.reply = frame
        return {"servo_id": frame[2], **_ASKS[message](self.servos, frame[2])}


def _steps(degrees: float) -> int:
    return round(degrees / 0.24)


def _errors(locked: bool, voltage: bool, temperature: bool) -> Values:
    return {"errors": locked << 2 | voltage << 1 | temperature}


# --- pylx16a -------------------------------------------------------------------------------------


def _angle(position: int) -> float:
    return position * 0.24


_TELLS_IN_ANGLES: dict[str, Tell] = {
    "Move": lambda servo, _, told: servo.move(_angle(told["position"]), told["time_ms"]),
    "MovePrepare": lambda servo, _, told: servo.move(
        _angle(told["position"]), told["time_ms"], wait=True
    ),
    "MoveStart": lambda servo, *_: servo.move_start(),
    "ServoIdWrite": lambda servo, _, told: servo.set_id(told["new_id"]),
    "OffsetAdjust": lambda servo, _, told: servo.set_angle_offset(_angle(told["offset"])),
    "OffsetSave": lambda servo, *_: servo.set_angle_offset(0, permanent=True),
    "PositionLimitsWrite": lambda servo, _, told: servo.set_angle_limits(
        _angle(told["lowest"]), _angle(told["highest"])
    ),
    "VoltageLimitsWrite": lambda servo, _, told: servo.set_vin_limits(
        told["lowest_mv"], told["highest_mv"]
    ),
    "TemperatureLimitWrite": lambda servo, _, told: servo.set_temp_limit(told["highest"]),
    "ModeWrite": lambda servo, _, told: (
        servo.motor_mode(told["speed"]) if told["mode"] else servo.servo_mode()
    ),
    "TorqueWrite": lambda servo, _, told: (
        servo.enable_torque() if told["torque"] else servo.disable_torque()
    ),
    "LedWrite": lambda servo, _, told: (
        servo.led_power_off() if told["led"] else servo.led_power_on()
    ),
    "LedErrorsWrite": lambda servo, _, told: servo.set_led_error_triggers(
        *(bool(told["errors"] & bit) for bit in (1, 2, 4))
    ),
}
_ASKS_IN_ANGLES: dict[str, Ask] = {
    "LastMove": lambda servo, _: _moved(*servo.get_last_instant_move_hw()),
    "PreparedMove": lambda servo, _: _moved(*servo.get_last_delayed_move_hw()),
    "ServoId": lambda servo, _: {"own_id": servo.get_id(poll_hardware=True)},
    "Offset": lambda servo, _: {"offset": _steps(servo.get_angle_offset(poll_hardware=True))},
    "PositionLimits": lambda servo, _: _two(
        "lowest", "highest", map(_steps, servo.get_angle_limits(poll_hardware=True))
    ),
    "VoltageLimits": lambda servo, _: _two(
        "lowest_mv", "highest_mv", servo.get_vin_limits(poll_hardware=True)
    ),
    "TemperatureLimit": lambda servo, _: {"highest": servo.get_temp_limit(poll_hardware=True)},
    "Temperature": lambda servo, _: {"temperature": servo.get_temp()},
    "Voltage": lambda servo, _: {"voltage_mv": servo.get_vin()},
    "Position": lambda servo, _: {"position": _steps(servo.get_physical_angle())},
    "Mode": lambda servo, _: {
        "mode": int(servo.is_motor_mode(poll_hardware=True)),
        "speed": servo.get_motor_speed(poll_hardware=True) or 0,
    },
    "Torque": lambda servo, _: {"torque": int(servo.is_torque_enabled(poll_hardware=True))},
    "Led": lambda servo, _: {"led": int(not servo.is_led_power_on(poll_hardware=True))},
    "LedErrors": lambda servo, _: _errors(*servo.get_led_error_triggers(poll_hardware=True)[::-1]),
}


def _moved(degrees: float, time_ms: int) -> Values:
    return {"position": _steps(degrees), "time_ms": time_ms}


def _in_turn(lowest: str, highest: str) -> Callable[[Values], Values]:
    """Return what puts two limits into the order that alone it takes."""

    def narrowed(values: Values) -> Values:
        low, high = sorted((values[lowest], values[highest]))
        return _to_one(values | {lowest: low, highest: high})

    return narrowed


class Pylx16a(Peer):
    """The client `pylx16a`: one servo each, in degrees. It asks a servo for all when it is made."""

    protocol = "lxservo"
    package = "pylx16a.lx16a"
    writes = (
        dict.fromkeys(_TELLS_IN_ANGLES, _to_one)
        | {name: _to_one for name, reply in _questions().items() if reply in _ASKS_IN_ANGLES}
        | {
            "ModeWrite": lambda values: _to_one(_mode(values)),
            "PositionLimitsWrite": _in_turn("lowest", "highest"),
            "VoltageLimitsWrite": _in_turn("lowest_mv", "highest_mv"),
            "TorqueWrite": lambda values: _to_one(_TORQUE(values)),
            "LedWrite": lambda values: _to_one(_LED(values)),
            "LedErrorsWrite": lambda values: _to_one(values | {"errors": values["errors"] & 7}),
        }
    )
    reads = dict.fromkeys(_ASKS_IN_ANGLES, _to_one) | {
        # To it, what is more is negative.
        "Offset": lambda values: _to_one(values | {"offset": min(values["offset"], 125)}),
        "Mode": lambda values: _to_one(_mode(values)),
        "Torque": lambda values: _to_one(_TORQUE(values)),
        "Led": lambda values: _to_one(_LED(values)),
        "LedErrors": lambda values: _to_one(values | {"errors": values["errors"] & 7}),
    }

    def __init__(self) -> None:
        super().__init__()
        self.wire = Wire()

    @contextmanager
    def servo(self, number: int) -> Iterator[Any]:
        """Return one that has been asked already: it may move, start, and tell its speed."""
        servo = self.module.LX16A.__new__(self.module.LX16A)
        servo._id, servo._angle_limits, servo._torque_enabled = number, (0, 1000), True
        servo._motor_mode, servo._waiting_for_move, servo._waiting_angle = False, True, 0
        # All of them have one line.
        self.module.LX16A._controller = self.wire
        try:
            yield servo
        finally:
            self.module.LX16A._controller = None

    def write(self, message: str, values: Values) -> bytes:
        with self.servo(values["servo_id"]) as servo:
            if message in _TELLS_IN_ANGLES:
                _TELLS_IN_ANGLES[message](servo, servo._id, values)
            else:
                with pytest.raises(self.module.ServoTimeoutError):
                    _ASKS_IN_ANGLES[_questions()[message]](servo, servo._id)
        return self.wire.written

    def read(self, message: str, frame: bytes) -> Values:
        self.wire.reply = frame
        with self.servo(frame[2]) as servo:
            servo._motor_mode = message == "Mode"
            return {"servo_id": frame[2], **_ASKS_IN_ANGLES[message](servo, frame[2])}
