"""What stands in front of the fields of frames, read at many places at once."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from .._frame.errors import Reason
from .places import read_numbers

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from .._explanation.protocol import Envelope, Slot
    from .found import Bytes, Numbers

FINE = -1
"""Stands for the reason of what nothing is wrong with."""

_NONE = -1
_REASONS = {reason.name: number for number, reason in enumerate(Reason)}


class Heads:
    """The heads of the frames of one envelope, whose messages have some ids."""

    def __init__(self, envelope: Envelope, ids: Sequence[tuple[int, ...]], largest: int) -> None:
        self._envelope = envelope
        self._largest = largest
        self._groups = len(ids)
        self._steps = _steps(envelope.ids, ids)

    def read(self, data: Bytes, places: Numbers) -> tuple[Numbers, Numbers, list[Numbers]]:
        """Read the heads at some places.

        Returns the size that each gives its frame, 0 for a size that none has; why none begins
        there, or FINE; and which places have each of the ids, and nothing wrong so far.
        """
        reason = np.full(len(places), FINE, np.int64)
        size: Numbers = np.zeros(len(places), np.int64)
        group: Numbers = np.zeros(len(places), np.int64)
        steps = iter(self._steps)

        def refuse(wrong: NDArray[np.bool_], why: str) -> None:
            reason[wrong & (reason == FINE)] = _REASONS[why]

        for placed in self._envelope.head:
            slot = placed.slot
            if slot.role in ("constant", "counter"):
                continue
            numbers = read_numbers(data, places + slot.at, slot)
            if slot.role == "length":
                size = numbers.astype(np.int64) + self._envelope.uncounted
                impossible = (size < self._envelope.least) | (size > self._largest)
                size[impossible] = 0
                refuse(impossible, "LENGTH_MISMATCH")
            elif slot.role == "address":
                refuse(~_holds(slot, numbers), "OUT_OF_RANGE")
            else:
                group = next(steps).follow(group, numbers)
                refuse(group == _NONE, "UNKNOWN_COMMAND")
        return size, reason, self._grouped(np.where(reason == FINE, group, _NONE))

    def _grouped(self, group: Numbers) -> list[Numbers]:
        # So narrow that they are sorted by their bytes, not by comparing them.
        narrow = group.astype(np.int16)
        order = np.argsort(narrow, kind="stable")
        bounds = np.searchsorted(narrow[order], np.arange(self._groups + 1))
        return [order[start:end] for start, end in pairwise(bounds.tolist())]


class _Step:
    """One id part: from the number of the ids before it to that of the ids with it."""

    def __init__(self, slot: Slot, after: dict[tuple[int, int], int], groups: int) -> None:
        self._values = np.array(sorted({value for _, value in after}), np.int64)
        places = {int(value): at for at, value in enumerate(self._values)}
        # The last row and the last column are for what is not known.
        self._table = np.full((groups + 1, len(self._values) + 1), _NONE, np.int64)
        for (group, value), there in after.items():
            self._table[group, places[value]] = there
        self._column: Numbers | None = None
        if slot.size == 1:
            self._column = np.full(256, len(self._values), np.int64)
            self._column[self._values] = np.arange(len(self._values))

    def follow(self, group: Numbers, numbers: NDArray[Any]) -> Numbers:
        """Return the number of the ids, with one more; _NONE for those that no message has."""
        found: Numbers = self._table[group, self._columns(numbers)]
        return found

    def _columns(self, numbers: NDArray[Any]) -> Numbers:
        if self._column is not None:
            known: Numbers = self._column[numbers]
            return known
        at = np.searchsorted(self._values, numbers.astype(np.int64))
        at[at == len(self._values)] = 0
        return np.where(self._values[at] == numbers, at, len(self._values))


def _steps(parts: Sequence[Slot], ids: Sequence[tuple[int, ...]]) -> list[_Step]:
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


def _holds(slot: Slot, numbers: NDArray[Any]) -> NDArray[np.bool_]:
    """Tell which addresses the protocol allows; those with a name may lie outside the range."""
    named = [each["value"] for each in slot.said.get("values", {}).values()]
    wide = numbers.astype(np.int64)
    return (wide >= slot.low) & (wide <= slot.high) | np.isin(wide, named)
