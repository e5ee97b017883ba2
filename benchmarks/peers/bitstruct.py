"""bitstruct: format strings in bits, interpreted in Python or in C.

It knows neither constants nor repetition, and gives plain tuples.
The format of every count is compiled once and kept, as its documentation advises,
and named tuples around it make the typed objects that every peer returns here.
"""

from __future__ import annotations

from functools import cache
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

import bitstruct
import bitstruct.c

from benchmarks import floor
from benchmarks.peers.interface import Peer

if TYPE_CHECKING:
    from collections.abc import Sequence


class ServoPosition(NamedTuple):
    """An element of a position reply."""

    servo_id: int
    position: int


class ServoPositions(NamedTuple):
    """The position reply."""

    positions: tuple[ServoPosition, ...]


class BatteryVoltage(NamedTuple):
    """The battery reply."""

    voltage_mv: int


class GroupReport(NamedTuple):
    """The report that an action group started or completed."""

    group: int
    times: int


class GroupStopped(NamedTuple):
    """The report that an action group was stopped."""


_MOVE = "u8" * 5 + "u16"
_POSITIONS = "p40"
_ITEM = "u8u16"
_GROUP = "p32u8u16"
_BATTERY = "p32u16"


class Bitstruct(Peer):
    """The version in Python, which knows byte orders."""

    name = "bitstruct"
    distribution = "bitstruct"
    import_statement = "import bitstruct"

    def __init__(self) -> None:
        super().__init__()
        self._moves = cache(lambda count: bitstruct.compile(_MOVE + _ITEM * count + "<"))
        self._positions = cache(lambda count: bitstruct.compile(_POSITIONS + _ITEM * count + "<"))
        self._group = bitstruct.compile(_GROUP + "<")
        self._battery = bitstruct.compile(_BATTERY + "<")
        self.parsers = {
            floor.ACTION_GROUP_STARTED: self._parse_group,
            floor.ACTION_GROUP_STOPPED: self._parse_stopped,
            floor.ACTION_GROUP_COMPLETED: self._parse_group,
            floor.BATTERY: self._parse_battery,
            floor.POSITIONS: self._parse_positions,
        }

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Encode with one `pack` of everything."""
        count = len(targets)
        flat = chain.from_iterable(targets)
        move = self._moves(count)
        frame: bytes = move.pack(0x55, 0x55, 3 * count + 5, floor.MOVE, count, time_ms, *flat)
        return frame

    def _parse_positions(self, frame: bytes) -> ServoPositions:
        flat = iter(self._positions(frame[4]).unpack(frame))
        return ServoPositions(tuple(map(ServoPosition, flat, flat)))

    def _parse_battery(self, frame: bytes) -> BatteryVoltage:
        return BatteryVoltage(*self._battery.unpack(frame))

    def _parse_group(self, frame: bytes) -> GroupReport:
        return GroupReport(*self._group.unpack(frame))

    def _parse_stopped(self, _: bytes) -> GroupStopped:
        return GroupStopped()

    def plain(self, command: int, message: Any) -> object:
        """Return the named tuple as it is; the floor has no tuple for battery and stopped group."""
        if command == floor.POSITIONS:
            return message.positions
        if command == floor.BATTERY:
            return message.voltage_mv
        if command == floor.ACTION_GROUP_STOPPED:
            return None
        return message


class BitstructC(Bitstruct):
    """The version in C, which is big endian only: bytes are swapped before or after."""

    name = "bitstruct.c"
    import_statement = "import bitstruct.c"

    def __init__(self) -> None:
        super().__init__()
        self._moves = cache(
            lambda count: (bitstruct.c.compile(_MOVE + _ITEM * count).pack, "111112" + "12" * count)
        )
        self._positions = cache(
            lambda count: (
                bitstruct.c.compile(_POSITIONS + _ITEM * count).unpack,
                "11111" + "12" * count,
            )
        )
        self._group = bitstruct.c.compile(_GROUP)
        self._battery = bitstruct.c.compile(_BATTERY)

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Encode with one `pack`, then one `byteswap`."""
        count = len(targets)
        flat = chain.from_iterable(targets)
        pack, swaps = self._moves(count)
        frame: bytes = bitstruct.c.byteswap(
            swaps, pack(0x55, 0x55, 3 * count + 5, floor.MOVE, count, time_ms, *flat)
        )
        return frame

    def _parse_positions(self, frame: bytes) -> ServoPositions:
        unpack, swaps = self._positions(frame[4])
        flat = iter(unpack(bitstruct.c.byteswap(swaps, frame)))
        return ServoPositions(tuple(map(ServoPosition, flat, flat)))

    def _parse_battery(self, frame: bytes) -> BatteryVoltage:
        return BatteryVoltage(*self._battery.unpack(bitstruct.c.byteswap("11112", frame)))

    def _parse_group(self, frame: bytes) -> GroupReport:
        return GroupReport(*self._group.unpack(bitstruct.c.byteswap("111112", frame)))


def peers() -> list[Peer]:
    """Return the peers of bitstruct: in Python and in C."""
    return [Bitstruct(), BitstructC()]
