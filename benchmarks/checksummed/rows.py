"""The rows of frames with checksums: what each one is given, and what the floor does with it."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from benchmarks.checksummed import floor

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

STREAM = 1 << 16
"""The bytes of a stream: they come at once."""


@dataclass(frozen=True)
class Row:
    """One unit of work in one protocol."""

    name: str
    head: str
    """What heads its column."""

    given: Mapping[str, Any]
    """What it is given, by name: values, a frame, or the bytes of a stream."""

    by_hand: Callable[..., Any]
    """What the floor does with that."""

    loop: floor.FramingLoop | None = None
    """The loop that finds the frames of a stream."""

    @property
    def protocol(self) -> str:
        """The protocol that the frames are of."""
        return self.name.partition("-")[0]


def _stream(name: str, frame: Callable[[random.Random], bytes], loop: floor.FramingLoop) -> Row:
    """Return the row of a stream of such frames, as many as there is room for."""
    rng = random.Random(name)
    frames: list[bytes] = []
    while sum(map(len, frames[:1])) * (len(frames) + 1) <= STREAM:
        frames.append(frame(rng))
    parse = _PARSERS[name]
    given = {"data": b"".join(frames)}
    return Row(name, "stream of 64 KiB", given, lambda data: loop.frames(data, parse), loop)


def _sealed(covered: bytes) -> bytes:
    return covered + bytes([~sum(covered) & 0xFF])


def _move(rng: random.Random) -> bytes:
    return floor.encode_move(rng.randrange(1, 7), rng.randrange(1001), rng.randrange(30001))


def _status(rng: random.Random) -> bytes:
    return b"\xff\xff" + _sealed(bytes([rng.randrange(1, 7), 6, 0]) + rng.randbytes(4))


def _acknowledged(rng: random.Random) -> bytes:
    covered = bytes([5, 1, 2, 0, 6, rng.randrange(64)])
    return b"\xb5\x62" + covered + floor.fletcher(covered).to_bytes(2, "little")


def _registers(rng: random.Random) -> bytes:
    covered = bytes([rng.randrange(1, 7), 3, 6]) + rng.randbytes(6)
    return covered + floor.crc(covered).to_bytes(2, "little")


_PARSERS: Mapping[str, Callable[[bytes], Any]] = {
    "lxservo-stream": floor.decode_move,
    "dynamixel1-stream": floor.decode_status,
    "ubx-stream": floor.decode_acknowledged,
    "modbus-stream": floor.decode_registers,
}

ROWS: Mapping[str, Row] = {
    row.name: row
    for row in (
        Row(
            "lxservo-encode",
            "encode Move",
            {"servo_id": 1, "position": 500, "time_ms": 1000},
            floor.encode_move,
        ),
        Row(
            "lxservo-decode",
            "decode Move",
            {"frame": bytes.fromhex("55 55 01 07 01 F4 01 E8 03 16")},
            floor.decode_move,
        ),
        Row(
            "lxservo-reply",
            "decode PreparedMove",
            {"frame": bytes.fromhex("55 55 01 07 08 F4 01 E8 03 0F")},
            floor.decode_move,
        ),
        _stream("lxservo-stream", _move, floor.FramingLoop(b"\x55\x55", 3, 3)),
        Row(
            "dynamixel1-encode",
            "encode Write",
            {"servo_id": 1, "start": 30, "data": [0, 2, 0, 2]},
            floor.encode_write,
        ),
        Row(
            "dynamixel1-decode",
            "decode Status",
            {"frame": b"\xff\xff" + _sealed(bytes([1, 6, 0, 0, 2, 0, 2]))},
            floor.decode_status,
        ),
        _stream("dynamixel1-stream", _status, floor.FramingLoop(b"\xff\xff", 3, 4)),
        Row(
            "ubx-encode",
            "encode CfgRateSet",
            {"period_ms": 1000, "solutions": 1, "time_reference": 1},
            floor.encode_rate,
        ),
        Row(
            "ubx-decode",
            "decode AckAck",
            {"frame": bytes.fromhex("B5 62 05 01 02 00 06 01 0F 38")},
            floor.decode_acknowledged,
        ),
        _stream("ubx-stream", _acknowledged, floor.FramingLoop(b"\xb5\x62", 4, 8)),
        Row(
            "modbus-encode",
            "encode HoldingRead",
            {"unit": 17, "start": 107, "quantity": 3},
            floor.encode_question,
        ),
        Row(
            "modbus-question",
            "decode HoldingRead",
            {"frame": bytes.fromhex("11 03 00 6B 00 03 76 87")},
            floor.decode_question,
        ),
        Row(
            "modbus-decode",
            "decode Holding",
            {"frame": bytes.fromhex("11 03 06 AE 41 56 52 43 40 49 AD")},
            floor.decode_registers,
        ),
        _stream("modbus-stream", _registers, floor.FramingLoop(b"", 2, 5)),
    )
}

PROTOCOLS = {
    "lxservo": "LX-16A servo bus, inverted sum",
    "dynamixel1": "DYNAMIXEL 1.0, inverted sum",
    "ubx": "UBX, two running sums",
    "modbus": "Modbus RTU, CRC by a table",
}
"""The protocols, and what is measured of each."""

_ALL = ("construct", "Kaitai Struct")
SPEAKERS = {
    "lxservo": (*_ALL, "lewansoul-lx16a", "lewanlib"),
    "dynamixel1": (*_ALL, "dynamixel-sdk"),
    "ubx": (*_ALL, "pyubx2"),
    "modbus": (*_ALL, "pymodbus"),
}
"""The peers that speak them."""
