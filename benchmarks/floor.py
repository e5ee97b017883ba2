"""The floor: the fastest codec written by hand with `struct`, and the unit of every ratio.

Nothing is validated, nothing is typed: values go in and come out as plain ints and tuples.
It is what a script without a library would hold, written with care for speed but without tricks.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from struct import Struct
from typing import Any

HEADER = b"\x55\x55"

MOVE = 0x03
ACTION_GROUP_STARTED = 0x06
ACTION_GROUP_STOPPED = 0x07
ACTION_GROUP_COMPLETED = 0x08
BATTERY = 0x0F
POSITIONS = 0x15

_pack_move_head = Struct("<BBBBBH").pack
_pack_item = Struct("<BH").pack
_iter_items = Struct("<BH").iter_unpack
_unpack_voltage = Struct("<4xH").unpack
_unpack_group = Struct("<4xBH").unpack

# Legal length bytes of what the controller sends, by command.
LENGTHS: Mapping[int, Collection[int]] = {
    ACTION_GROUP_STARTED: frozenset([5]),
    ACTION_GROUP_STOPPED: frozenset([2]),
    ACTION_GROUP_COMPLETED: frozenset([5]),
    BATTERY: frozenset([4]),
    POSITIONS: frozenset(range(3, 256, 3)),
}


def encode_move(time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
    """Return the MOVE frame of these (servo id, position) pairs."""
    count = len(targets)
    return _pack_move_head(0x55, 0x55, 3 * count + 5, MOVE, count, time_ms) + b"".join(
        [_pack_item(servo_id, position) for servo_id, position in targets]
    )


def decode_positions(frame: bytes) -> tuple[tuple[int, int], ...]:
    """Return the (servo id, position) pairs of a position reply."""
    return tuple(_iter_items(frame[5:]))


def decode_battery(frame: bytes) -> int:
    """Return the millivolts of a battery reply."""
    voltage_mv: int = _unpack_voltage(frame)[0]
    return voltage_mv


def decode_group(frame: bytes) -> tuple[int, int]:
    """Return the (group, times) of an action group that started or completed."""
    group, times = _unpack_group(frame)
    return group, times


def decode_stopped(frame: bytes) -> None:
    """Decode the report of a stopped action group: its frame carries nothing else."""


Parser = Callable[[bytes], Any]

PARSERS: Mapping[int, Parser] = {
    ACTION_GROUP_STARTED: decode_group,
    ACTION_GROUP_STOPPED: decode_stopped,
    ACTION_GROUP_COMPLETED: decode_group,
    BATTERY: decode_battery,
    POSITIONS: decode_positions,
}


class FramingLoop:
    """A loop that finds 55 55, tests length and count, and hands each frame to its parser.

    With the floor's own parsers it is the floor of the stream rows.
    A peer without a stream decoder gets this same loop around its parsers,
    so that what differs between the two is the parser alone.
    """

    def __init__(self, parsers: Mapping[int, Parser] = PARSERS) -> None:
        self._parsers = parsers
        self._rest = b""

    def feed(self, data: bytes) -> list[tuple[int, Any]]:
        """Return the (command, parsed frame) pairs that `data` completes."""
        buffer = self._rest + data
        size = len(buffer)
        messages: list[tuple[int, Any]] = []
        start = 0
        while True:
            found = buffer.find(HEADER, start)
            if found < 0:
                # The last byte may be the first half of a header.
                self._rest = b"\x55" if buffer.endswith(b"\x55", start) else b""
                return messages
            start = found
            if size - start < 4:
                break
            length = buffer[start + 2]
            command = buffer[start + 3]
            if length not in LENGTHS.get(command, ()):
                start += 1
                continue
            end = start + 2 + length
            if end > size:
                break
            if command == POSITIONS and length != 3 * buffer[start + 4] + 3:
                start += 1
                continue
            messages.append((command, self._parsers[command](buffer[start:end])))
            start = end
        self._rest = buffer[start:]
        return messages
