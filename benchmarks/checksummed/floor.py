"""The floor for frames with checksums: `struct` by hand, and the checksum as one writes it.

Nothing is validated but the checksum, nothing is typed: values go in and come out as plain ints and
tuples. A frame whose checksum is wrong is a ValueError.
"""

from __future__ import annotations

from dataclasses import dataclass
from struct import Struct
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

WRONG = "wrong checksum"


# The LX-16A servo bus: the bytes added up, and inverted.

_unpack_move = Struct("<2xB2xHHB").unpack
_pack_move = Struct("<BBBHH").pack


def decode_move(frame: bytes) -> tuple[int, int, int]:
    """Return the (servo id, position, milliseconds) of a move, told or reported."""
    servo_id, position, time_ms, checksum = _unpack_move(frame)
    if ~sum(frame[2:-1]) & 0xFF != checksum:
        raise ValueError(WRONG)
    return servo_id, position, time_ms


def encode_move(servo_id: int, position: int, time_ms: int) -> bytes:
    """Return the frame that tells a servo to move."""
    covered = _pack_move(servo_id, 7, 1, position, time_ms)
    return b"\x55\x55" + covered + bytes([~sum(covered) & 0xFF])


# DYNAMIXEL 1.0: the same sum.


def decode_status(frame: bytes) -> tuple[int, int, tuple[int, ...]]:
    """Return the (actuator, error, data) of a status."""
    if ~sum(frame[2:-1]) & 0xFF != frame[-1]:
        raise ValueError(WRONG)
    return frame[2], frame[4], tuple(frame[5:-1])


def encode_write(servo_id: int, start: int, data: list[int]) -> bytes:
    """Return the frame that writes bytes to the control table of an actuator."""
    covered = bytes([servo_id, len(data) + 3, 3, start, *data])
    return b"\xff\xff" + covered + bytes([~sum(covered) & 0xFF])


# UBX: two running sums.

_unpack_acknowledged = Struct("<6xBBH").unpack
_pack_rate = Struct("<BBHHHH").pack


def fletcher(data: bytes) -> int:
    """Return the two sums of some bytes, the second above the first."""
    first = second = 0
    for byte in data:
        first = first + byte & 0xFF
        second = second + first & 0xFF
    return second << 8 | first


def decode_acknowledged(frame: bytes) -> tuple[int, int]:
    """Return the (class, message) of what a receiver has taken."""
    message_class, message_id, checksum = _unpack_acknowledged(frame)
    if fletcher(frame[2:-2]) != checksum:
        raise ValueError(WRONG)
    return message_class, message_id


def encode_rate(period_ms: int, solutions: int, time_reference: int) -> bytes:
    """Return the frame that sets how often there is a solution."""
    covered = _pack_rate(6, 8, 6, period_ms, solutions, time_reference)
    return b"\xb5\x62" + covered + fletcher(covered).to_bytes(2, "little")


# Modbus RTU: a CRC by a table of what each byte makes of it.

_unpack_question = Struct(">B1xHH").unpack_from
_pack_question = Struct(">BBHH").pack
_REGISTERS = [Struct(f">{count}H").unpack_from for count in range(126)]


def _of_byte(value: int) -> int:
    for _ in range(8):
        value = value >> 1 ^ (0xA001 if value & 1 else 0)
    return value


_TABLE = [_of_byte(byte) for byte in range(256)]


def crc(data: bytes) -> int:
    """Return the CRC of some bytes."""
    value = 0xFFFF
    for byte in data:
        value = _TABLE[(value ^ byte) & 0xFF] ^ value >> 8
    return value


def decode_registers(frame: bytes) -> tuple[int, tuple[int, ...]]:
    """Return the (unit, registers) of a reply."""
    if crc(frame[:-2]) != frame[-2] | frame[-1] << 8:
        raise ValueError(WRONG)
    return frame[0], _REGISTERS[frame[2] // 2](frame, 3)


def decode_question(frame: bytes) -> tuple[int, int, int]:
    """Return the (unit, start, quantity) of a question for registers."""
    if crc(frame[:-2]) != frame[-2] | frame[-1] << 8:
        raise ValueError(WRONG)
    unit, start, quantity = _unpack_question(frame)
    return unit, start, quantity


def encode_question(unit: int, start: int, quantity: int) -> bytes:
    """Return the frame that asks for registers."""
    covered = _pack_question(unit, 3, start, quantity)
    return covered + crc(covered).to_bytes(2, "little")


@dataclass(frozen=True)
class FramingLoop:
    """A loop that finds a header, takes the length behind it, and hands each frame to a parser.

    With the floor's own parser it is the floor of the stream rows. A peer without a stream decoder
    gets this same loop around its parser, so that what differs between the two is the parser alone.
    """

    header: bytes
    length_at: int
    uncounted: int

    def frames(self, data: bytes, parse: Callable[[bytes], Any]) -> list[Any]:
        """Return all frames of `data`, parsed."""
        header, length_at, uncounted = self.header, self.length_at, self.uncounted
        size, at = len(data), 0
        found: list[Any] = []
        while True:
            at = data.find(header, at)
            if at < 0 or at + length_at >= size:
                return found
            end = at + data[at + length_at] + uncounted
            if end > size:
                return found
            try:
                found.append(parse(data[at:end]))
            except ValueError:
                at += 1
            else:
                at = end
