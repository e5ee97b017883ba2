"""Kaitai Struct: classes that its compiler generates from `checksummed_frames.ksy`.

Its language has no checksums. A class keeps the bytes that one covers, and the same function that
the floor has is called on them afterwards, as a user would.
"""

from __future__ import annotations

import tempfile
from io import BytesIO
from typing import TYPE_CHECKING, Any

from kaitaistruct import KaitaiStream, ValidationFailedError

from benchmarks.checksummed import floor
from benchmarks.checksummed.peers.interface import Peer, Work
from benchmarks.checksummed.rows import ROWS
from benchmarks.peers.kaitai import FOLDER, compiled

if TYPE_CHECKING:
    from collections.abc import Callable

_SOURCE = FOLDER / "checksummed_frames.ksy"

# The class of a row, what its checksum is, and the names of its values in the order of the floor.
_FRAMES: dict[str, tuple[str, Callable[[bytes], int], tuple[str, ...]]] = {
    "lxservo-decode": ("Move", lambda data: ~sum(data) & 0xFF, ("servo_id", "position", "time_ms")),
    "dynamixel1-decode": (
        "Status",
        lambda data: ~sum(data) & 0xFF,
        ("servo_id", "error", "data"),
    ),
    "ubx-decode": ("Acknowledged", floor.fletcher, ("message_class", "message_id")),
    "modbus-question": ("Question", floor.crc, ("unit", "start", "quantity")),
    "modbus-decode": ("Registers", floor.crc, ("unit", "registers")),
}
_FRAMES |= {
    "lxservo-reply": _FRAMES["lxservo-decode"],
    **{
        f"{protocol}-stream": _FRAMES[f"{protocol}-decode"]
        for protocol in ("lxservo", "dynamixel1", "ubx", "modbus")
    },
}


def _work(name: str, kind: Any, method: Callable[[bytes], int], names: tuple[str, ...]) -> Work:
    def parse(data: bytes) -> Any:
        frame = kind(KaitaiStream(BytesIO(data)))
        if method(frame._raw_covered) != frame.checksum:
            raise ValueError(floor.WRONG)
        return frame

    def parse_or_refuse(data: bytes) -> Any:
        try:
            return parse(data)
        except ValidationFailedError as error:
            raise ValueError from error

    def plain(frame: Any) -> tuple[Any, ...]:
        values = [getattr(frame.covered, each) for each in names]
        return tuple(tuple(each) if isinstance(each, list) else each for each in values)

    loop = ROWS[name].loop
    if loop is None:
        return Work(parse, plain)
    return Work(lambda data: loop.frames(data, parse_or_refuse), lambda found: [*map(plain, found)])


class Kaitai(Peer):
    """Reading by read-only classes, which are faster; it is not timed at writing."""

    name = "Kaitai Struct"
    distribution = "kaitaistruct"
    remark = "its language has no checksums; the floor's function is called on its raw bytes"

    def __init__(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            module = compiled(folder, _SOURCE)
        self.works = {
            name: _work(name, getattr(module, kind), method, names)
            for name, (kind, method, names) in _FRAMES.items()
        }


def peers() -> list[Peer]:
    """Return the peers of Kaitai Struct."""
    return [Kaitai()]
