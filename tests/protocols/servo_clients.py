"""Clients of the LX-16A servo bus, from the package index.

They are `lewansoul-lx16a` and `pylx16a`.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import pytest

from tests.protocols.peer import Peer, Values, as_is, with_values
from tests.protocols.specs import messages_of

# What tells a servo something, and what asks it; a client, the servo, and values by their names.
Tell: TypeAlias = Callable[[Any, int, Values], object]
Ask: TypeAlias = Callable[[Any, int], Values]


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


def _tell(method: str, *names: str) -> Tell:
    """Return what calls a method of a client with the servo and the values of these names."""
    return lambda client, to, told: getattr(client, method)(to, *(told[name] for name in names))


def _ask(method: str, *names: str) -> Ask:
    """Return what calls a method of a client with the servo, and names what it returns."""

    def asked(client: Any, to: int) -> Values:
        found = getattr(client, method)(to)
        return dict(zip(names, found if names[1:] else (found,), strict=True))

    return asked


_TORQUE = with_values(torque=lambda value: value & 1)
_LED = with_values(led=lambda value: value & 1)


# A method by its name, and the values that it takes.
_TELLS: dict[str, Tell] = {
    "Move": _tell("move", "position", "time_ms"),
    "MovePrepare": _tell("move_prepare", "position", "time_ms"),
    "MoveStart": _tell("move_start"),
    "MoveStop": _tell("move_stop"),
    "ServoIdWrite": _tell("set_servo_id", "new_id"),
    "OffsetAdjust": _tell("set_position_offset", "offset"),
    "OffsetSave": _tell("save_position_offset"),
    "PositionLimitsWrite": _tell("set_position_limits", "lowest", "highest"),
    "VoltageLimitsWrite": _tell("set_voltage_limits", "lowest_mv", "highest_mv"),
    "TemperatureLimitWrite": _tell("set_max_temperature_limit", "highest"),
    "ModeWrite": lambda servos, to, told: (
        servos.set_motor_mode(to, told["speed"]) if told["mode"] else servos.set_servo_mode(to)
    ),
    "TorqueWrite": lambda servos, to, told: (
        servos.motor_on(to) if told["torque"] else servos.motor_off(to)
    ),
    "LedWrite": lambda servos, to, told: servos.led_off(to) if told["led"] else servos.led_on(to),
    "LedErrorsWrite": _tell("set_led_errors", "errors"),
}
# By the message that replies.
_ASKS: dict[str, Ask] = {
    "PreparedMove": _ask("get_prepared_move", "position", "time_ms"),
    "ServoId": _ask("get_servo_id", "own_id"),
    "Offset": _ask("get_position_offset", "offset"),
    "PositionLimits": _ask("get_position_limits", "lowest", "highest"),
    "VoltageLimits": _ask("get_voltage_limits", "lowest_mv", "highest_mv"),
    "TemperatureLimit": _ask("get_max_temperature_limit", "highest"),
    "Temperature": _ask("get_temperature", "temperature"),
    "Voltage": _ask("get_voltage", "voltage_mv"),
    "Position": _ask("get_position", "position"),
    "Mode": lambda servos, to: {
        "mode": servos.get_mode(to),
        "speed": servos.get_motor_speed(to),
    },
    "Torque": lambda servos, to: {"torque": int(servos.is_motor_on(to))},
    "Led": lambda servos, to: {"led": 1 - servos.is_led_on(to)},
    "LedErrors": _ask("get_led_errors", "errors"),
}


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


def _moved(degrees: float, time_ms: int) -> Values:
    return {"position": _steps(degrees), "time_ms": time_ms}


# What the other asks as well, but for the first: here, positions are in degrees.
_ASKS_IN_ANGLES: dict[str, Ask] = {
    "LastMove": lambda servo, _: _moved(*servo.get_last_instant_move_hw()),
    "Position": lambda servo, _: {"position": _steps(servo.get_physical_angle())},
    "Voltage": lambda servo, _: {"voltage_mv": servo.get_vin()},
}


class Pylx16a(Peer):
    """The client `pylx16a`: one servo each, in degrees. It asks a servo for all when it is made."""

    protocol = "lxservo"
    package = "pylx16a.lx16a"
    writes = dict.fromkeys(
        [name for name, reply in _questions().items() if reply in _ASKS_IN_ANGLES], _to_one
    )
    reads = dict.fromkeys(_ASKS_IN_ANGLES, _to_one)

    def __init__(self) -> None:
        super().__init__()
        self.wire = Wire()

    @contextmanager
    def servo(self, number: int) -> Iterator[Any]:
        """Return one that has been asked already; all of them have one line."""
        servo = self.module.LX16A.__new__(self.module.LX16A)
        servo._id = number
        self.module.LX16A._controller = self.wire
        try:
            yield servo
        finally:
            self.module.LX16A._controller = None

    def write(self, message: str, values: Values) -> bytes:
        ask = _ASKS_IN_ANGLES[_questions()[message]]
        with self.servo(values["servo_id"]) as servo, pytest.raises(self.module.ServoTimeoutError):
            ask(servo, servo._id)
        return self.wire.written

    def read(self, message: str, frame: bytes) -> Values:
        self.wire.reply = frame
        with self.servo(frame[2]) as servo:
            return {"servo_id": frame[2], **_ASKS_IN_ANGLES[message](servo, frame[2])}
