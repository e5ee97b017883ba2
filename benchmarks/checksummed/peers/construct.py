"""construct: declared structures with a `Checksum` over a `RawCopy`, as in its documentation."""

from __future__ import annotations

from typing import Any

from construct import (
    Array,
    Byte,
    Checksum,
    ChecksumError,
    Const,
    Int16ub,
    Int16ul,
    RawCopy,
    Rebuild,
    Struct,
    len_,
    this,
)

from benchmarks.checksummed import floor
from benchmarks.checksummed.peers.interface import Peer, Work
from benchmarks.checksummed.rows import ROWS


def _inverted_sum(data: bytes) -> int:
    return ~sum(data) & 0xFF


def _frame(header: bytes, covered: Any, checksum: Any, method: Any) -> Any:
    """Return a frame whose checksum covers all behind its header."""
    front = ["header" / Const(header)] if header else []
    return Struct(
        *front,
        "covered" / RawCopy(covered),
        "checksum" / Checksum(checksum, method, this.covered.data),
    )


def _move(command: int) -> Any:
    covered = Struct(
        "servo_id" / Byte,
        "length" / Const(7, Byte),
        "command" / Const(command, Byte),
        "position" / Int16ul,
        "time_ms" / Int16ul,
    )
    return _frame(b"\x55\x55", covered, Byte, _inverted_sum)


_STATUS = _frame(
    b"\xff\xff",
    Struct(
        "servo_id" / Byte, "length" / Byte, "error" / Byte, "data" / Array(this.length - 2, Byte)
    ),
    Byte,
    _inverted_sum,
)
_WRITE = _frame(
    b"\xff\xff",
    Struct(
        "servo_id" / Byte,
        "length" / Rebuild(Byte, len_(this.data) + 3),
        "instruction" / Const(3, Byte),
        "start" / Byte,
        "data" / Array(this.length - 3, Byte),
    ),
    Byte,
    _inverted_sum,
)
_ACKNOWLEDGED = _frame(
    b"\xb5\x62",
    Struct("ids" / Const(b"\x05\x01\x02\x00"), "message_class" / Byte, "message_id" / Byte),
    Int16ul,
    floor.fletcher,
)
_RATE = _frame(
    b"\xb5\x62",
    Struct(
        "ids" / Const(b"\x06\x08\x06\x00"),
        "period_ms" / Int16ul,
        "solutions" / Int16ul,
        "time_reference" / Int16ul,
    ),
    Int16ul,
    floor.fletcher,
)
_QUESTION = _frame(
    b"",
    Struct("unit" / Byte, "function" / Const(3, Byte), "start" / Int16ub, "quantity" / Int16ub),
    Int16ul,
    floor.crc,
)
_REGISTERS = _frame(
    b"",
    Struct(
        "unit" / Byte,
        "function" / Const(3, Byte),
        "size" / Byte,
        "registers" / Array(this.size // 2, Int16ub),
    ),
    Int16ul,
    floor.crc,
)

# The frame of a row, and the names of its values in the order of the floor.
_FRAMES: dict[str, tuple[Any, tuple[str, ...]]] = {
    "lxservo-encode": (_move(1), ("servo_id", "position", "time_ms")),
    "lxservo-decode": (_move(1), ("servo_id", "position", "time_ms")),
    "lxservo-reply": (_move(8), ("servo_id", "position", "time_ms")),
    "lxservo-stream": (_move(1), ("servo_id", "position", "time_ms")),
    "dynamixel1-encode": (_WRITE, ("servo_id", "start", "data")),
    "dynamixel1-decode": (_STATUS, ("servo_id", "error", "data")),
    "dynamixel1-stream": (_STATUS, ("servo_id", "error", "data")),
    "ubx-encode": (_RATE, ("period_ms", "solutions", "time_reference")),
    "ubx-decode": (_ACKNOWLEDGED, ("message_class", "message_id")),
    "ubx-stream": (_ACKNOWLEDGED, ("message_class", "message_id")),
    "modbus-encode": (_QUESTION, ("unit", "start", "quantity")),
    "modbus-question": (_QUESTION, ("unit", "start", "quantity")),
    "modbus-decode": (_REGISTERS, ("unit", "registers")),
    "modbus-stream": (_REGISTERS, ("unit", "registers")),
}


def _work(name: str, frame: Any, names: tuple[str, ...]) -> Work:
    loop = ROWS[name].loop

    def build(*values: Any) -> Any:
        return frame.build({"covered": {"value": dict(zip(names, values, strict=True))}})

    def plain(parsed: Any) -> tuple[Any, ...]:
        values = [parsed.covered.value[each] for each in names]
        return tuple(tuple(each) if isinstance(each, list) else each for each in values)

    def parse(data: bytes) -> Any:
        try:
            return frame.parse(data)
        except ChecksumError as error:
            raise ValueError from error

    if loop is not None:
        return Work(lambda data: loop.frames(data, parse), lambda found: [*map(plain, found)])
    return Work(build) if name.endswith("encode") else Work(frame.parse, plain)


class Construct(Peer):
    """Structures as they are declared."""

    name = "construct"
    distribution = "construct"

    def __init__(self) -> None:
        self.works = {
            name: _work(name, self._made(frame), names) for name, (frame, names) in _FRAMES.items()
        }

    def _made(self, frame: Any) -> Any:
        return frame


class CompiledConstruct(Construct):
    """The same structures, compiled to Python by construct itself."""

    name = "construct, compiled"

    def _made(self, frame: Any) -> Any:
        return frame.compile()


def peers() -> list[Peer]:
    """Return the peers of construct: interpreted and compiled."""
    return [Construct(), CompiledConstruct()]
