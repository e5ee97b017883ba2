"""What stands in front of the fields of frames, read at many places at once."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from ...protocol.slots import Constant, Number
from ...recording.layout import REASON_NUMBERS
from ..places import read_blocks, read_numbers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ...protocol.envelope import Envelope
    from ..events import Bytes, Numbers

FINE = -1
"""Stands for the reason of what nothing is wrong with."""

_NONE = -1


@dataclass(frozen=True, slots=True)
class ReadHeads:
    """The heads at some places: the size that each gives its frame, 0 for a size that none has.

    `reason` says why no frame begins there, or FINE. `order` has those first that nothing is wrong
    with, sorted by their ids; `bounds` says where those of each begin and end in it.
    """

    size: NDArray[np.int32]
    reason: NDArray[np.int8]
    order: Numbers
    bounds: list[tuple[int, int]]


class Heads:
    """The heads of the frames of one envelope, whose messages have some ids."""

    def __init__(self, envelope: Envelope, ids: Sequence[tuple[int, ...]], largest: int) -> None:
        self._envelope = envelope
        self._largest = largest
        self._ids = len(ids)
        self._steps = _steps(envelope.ids, ids)

    def read(self, data: Bytes, places: Numbers) -> ReadHeads:
        """Read the heads at some places."""
        reason = np.full(len(places), FINE, np.int8)
        size: NDArray[np.int32] = np.zeros(len(places), np.int32)
        group: NDArray[np.int16] = np.zeros(len(places), np.int16)
        steps = iter(self._steps)

        def refuse(wrong: NDArray[np.bool_], why: str) -> None:
            if wrong.any():
                reason[wrong & (reason == FINE)] = REASON_NUMBERS[why]

        for placed in self._envelope.head:
            slot = placed.slot
            if slot.role == "counter" or slot.at < len(self._envelope.header):
                continue
            if isinstance(slot, Constant):
                refuse(~_has(slot, data, places), "BAD_HEADER")
            if not isinstance(slot, Number):
                continue
            numbers = read_numbers(data, places + slot.at, slot)
            if slot.role == "length":
                size = numbers.astype(np.int32) + np.int32(self._envelope.uncounted)
                impossible = (size < self._envelope.least) | (size > self._largest)
                size[impossible] = 0
                refuse(impossible, "LENGTH_MISMATCH")
            elif slot.role == "address":
                refuse(~_holds(slot, numbers), "OUT_OF_RANGE")
            else:
                group = next(steps).follow(group, numbers)
                refuse(group == _NONE, "UNKNOWN_COMMAND")
        # So narrow that they are sorted by their bytes, not by comparing them; what is wrong last.
        group[reason != FINE] = self._ids
        order = np.argsort(group, kind="stable")
        ends = np.cumsum(np.bincount(group, minlength=self._ids))[: self._ids]
        return ReadHeads(size, reason, order, [*pairwise([0, *ends.tolist()])])

    def are_around(self, data: Bytes, places: Numbers) -> NDArray[np.bool_]:
        """Tell where constants and address are those of a frame, whatever its id is."""
        right = np.ones(len(places), np.bool_)
        for placed in self._envelope.head:
            slot = placed.slot
            if isinstance(slot, Constant):
                right &= _has(slot, data, places)
            elif isinstance(slot, Number) and slot.role == "address":
                right &= _holds(slot, read_numbers(data, places + slot.at, slot))
        return right


class _Step:
    """One id part: from the number of the ids before it to that of the ids with it."""

    def __init__(self, slot: Number, after: dict[tuple[int, int], int], before: int) -> None:
        self._values = np.array(sorted({value for _, value in after}), np.int64)
        width = len(self._values) + 1
        # The last row and the last column are for what is not known.
        table = np.full((before + 1, width), _NONE, np.int16)
        columns = {int(value): at for at, value in enumerate(self._values)}
        for (group, value), there in after.items():
            table[group, columns[value]] = there
        self._table = table.reshape(-1)
        self._rows, self._width = table.shape
        self._column: NDArray[np.int16] | None = None
        if slot.size == 1:
            self._column = np.full(256, len(self._values), np.int16)
            self._column[self._values] = np.arange(len(self._values))

    def follow(self, group: NDArray[np.int16], numbers: NDArray[Any]) -> NDArray[np.int16]:
        """Return the number of the ids, with one more; _NONE for those that no message has."""
        columns = self._columns(numbers)
        if self._rows > 2:
            row = np.where(group == _NONE, self._rows - 1, group)
            columns = columns + row.astype(np.int64) * self._width
        return self._table.take(columns)

    def _columns(self, numbers: NDArray[Any]) -> NDArray[Any]:
        if self._column is not None:
            return self._column.take(numbers)
        at = np.searchsorted(self._values, numbers.astype(np.int64))
        at[at == len(self._values)] = 0
        return np.where(self._values[at] == numbers, at, len(self._values))


def _steps(parts: Sequence[Number], ids: Sequence[tuple[int, ...]]) -> list[_Step]:
    """Return a step for each id part; after the last, ids are numbered in their order."""
    before: dict[tuple[int, ...], int] = {(): 0}
    found: list[_Step] = []
    for size, part in enumerate(parts, 1):
        begun = [each[:size] for each in ids]
        numbers = {each: number for number, each in enumerate(dict.fromkeys(begun))}
        after = {(before[each[:-1]], each[-1]): number for each, number in numbers.items()}
        found.append(_Step(part, after, len(before)))
        before = numbers
    return found


def _has(slot: Constant, data: Bytes, places: Numbers) -> NDArray[np.bool_]:
    """Tell where a constant stands."""
    found = read_blocks(data, places + slot.at, slot.size)
    right: NDArray[np.bool_] = (found == np.frombuffer(slot.data, np.uint8)).all(axis=1)
    return right


def _holds(slot: Number, numbers: NDArray[Any]) -> NDArray[np.bool_]:
    """Tell which addresses the protocol allows; those with a name may lie outside the range."""
    allowed: NDArray[np.bool_] = (numbers >= slot.low) & (numbers <= slot.high)
    for each in slot.values.values():
        allowed |= numbers == each.value
    return allowed
