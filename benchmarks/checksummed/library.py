"""The generated libraries, and the statements with which their users do the work of each row."""

from __future__ import annotations

import atexit
import importlib
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from benchmarks.messages import Case
from benchmarks.results import GENERATED, GENERATED_READ

if TYPE_CHECKING:
    from collections.abc import Mapping
    from types import ModuleType

    from benchmarks.checksummed.rows import Row

_ROOT = Path(__file__).resolve().parents[2]
_SPECS = {
    "lxservo": "spec/lxservo.yaml",
    "dynamixel1": "tests/protocols/dynamixel1.yaml",
    "ubx": "tests/protocols/ubx.yaml",
    "modbus": "tests/protocols/modbus.yaml",
}


@dataclass(frozen=True)
class Use:
    """How users do the work of a row."""

    direction: str
    """Who sends to whom."""

    statement: str
    fields: tuple[str, ...] = ()
    """What can be read of a message; nothing of one that is only encoded."""


_DECODE = "decode(frame, direction)"
_FEED = "StreamDecoder(direction).feed(data)"
_MOVE = ("servo_id", "position", "time_ms")
_REPORT = ("servo_id", "error", "data")

_USES: Mapping[str, Use] = {
    "lxservo-encode": Use("HOST_TO_SERVO", "Move(servo_id, position, time_ms).encode()"),
    "lxservo-decode": Use("HOST_TO_SERVO", _DECODE, _MOVE),
    "lxservo-reply": Use("SERVO_TO_HOST", _DECODE, _MOVE),
    "lxservo-stream": Use("HOST_TO_SERVO", _FEED, _MOVE),
    "dynamixel1-encode": Use("CONTROLLER_TO_ACTUATOR", "Write(servo_id, start, data).encode()"),
    "dynamixel1-decode": Use("ACTUATOR_TO_CONTROLLER", _DECODE, _REPORT),
    "dynamixel1-stream": Use("ACTUATOR_TO_CONTROLLER", _FEED, _REPORT),
    "ubx-encode": Use(
        "HOST_TO_RECEIVER", "CfgRateSet(period_ms, solutions, time_reference).encode()"
    ),
    "ubx-decode": Use("RECEIVER_TO_HOST", _DECODE, ("message_class", "message_id")),
    "ubx-stream": Use("RECEIVER_TO_HOST", _FEED, ("message_class", "message_id")),
    "modbus-encode": Use("CLIENT_TO_DEVICE", "HoldingRead(unit, start, quantity).encode()"),
    "modbus-question": Use("CLIENT_TO_DEVICE", _DECODE, ("unit", "start", "quantity")),
    "modbus-decode": Use("DEVICE_TO_CLIENT", _DECODE, ("unit", "registers")),
    "modbus-stream": Use("DEVICE_TO_CLIENT", _FEED, ("unit", "registers")),
}


@cache
def _library(protocol: str) -> ModuleType:
    """Return the library of a protocol, generated for this run alone."""
    folder = tempfile.mkdtemp()
    atexit.register(shutil.rmtree, folder)
    command = [sys.executable, "-m", "framegen", "generate", "--out", folder, _SPECS[protocol]]
    subprocess.run(command, cwd=_ROOT, check=True, capture_output=True)
    # In front of all others, of which one may be installed.
    sys.path.insert(0, str(Path(folder, "generated")))
    return importlib.import_module(protocol)


def cases(row: Row) -> list[Case]:
    """Return the cases of a row: the message alone, and every field of it read."""
    library, use = _library(row.protocol), _USES[row.name]
    statement, fields = use.statement, use.fields
    called = statement.partition("(")[0]
    names = {**row.given, called: getattr(library, called)}
    names["direction"] = library.Direction[use.direction]
    if not fields:
        return [Case(GENERATED, statement, statement, names)]
    plain = partial(_plain_all if statement == _FEED else _plain, fields)
    reading = "; ".join(f"message.{field}" for field in fields)
    whole = f"message = {statement}; {reading}"
    if statement == _FEED:
        whole = f"for message in {statement}:\n    {reading}"
    return [
        Case(GENERATED, statement, statement, names, plain),
        Case(GENERATED_READ, whole, statement, names, plain),
    ]


def _plain(fields: tuple[str, ...], message: Any) -> object:
    """Return a message in the form of the floor: used to check, never timed."""
    return tuple(getattr(message, name) for name in fields)


def _plain_all(fields: tuple[str, ...], messages: list[Any]) -> object:
    return [_plain(fields, message) for message in messages]
