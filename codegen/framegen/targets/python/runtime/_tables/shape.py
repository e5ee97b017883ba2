"""The fields of one message, tested in many frames at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._frame.errors import Reason
from .heads import FINE
from .layout import DIRECTIONS
from .places import read_blocks, read_numbers

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from .._explanation.protocol import Slot
    from .found import Bytes, Numbers
    from .layout import Layout
    from .sums import Sums

_REASONS = {reason.name: number for number, reason in enumerate(Reason)}
_HIGHEST_CHARACTER = 0x7F


class Shape:
    """The tests that a frame of a message must pass behind its head."""

    def __init__(self, layout: Layout) -> None:
        described = layout.described
        self.kind = layout.number
        self.direction = DIRECTIONS.index(layout.kind.DIRECTION)
        self._described = described
        self._uncounted = described.frame.uncounted
        self._tested = [slot for slot in described.fields if _is_tested(slot)]

    def fits(self, sizes: Numbers) -> NDArray[np.bool_]:
        """Tell which of these sizes a frame can have."""
        lengths = self._described.lengths
        step = lengths.step if isinstance(lengths, range) else 1
        over = sizes - self._uncounted - lengths[0]
        fits: NDArray[np.bool_] = (
            (over >= 0) & (over <= lengths[-1] - lengths[0]) & (over % step == 0)
        )
        return fits

    def judge(self, sums: Sums, places: Numbers, sizes: Numbers) -> tuple[Numbers, Numbers]:
        """Return why each of these frames is none, or FINE; and the byte at which that shows."""
        trial = _Trial(sums.data, places, sizes, self._counts(sizes))
        items = self._described.items
        for slot in self._tested:
            if slot.role in ("count", "size") and items is not None:
                trial.count(slot, items.size if slot.role == "size" else 1)
            elif slot.role == "list":
                trial.listed(slot)
            else:
                trial.part(slot, slot.at)
        for part in self._described.frame.checksums:
            right = sums.are_right(self._described.frame, part, places, sizes)
            trial.refuse(~right, "BAD_CHECKSUM", sizes + part.at)
        return trial.why, trial.at

    def _counts(self, sizes: Numbers) -> Numbers:
        """Return how many elements the list has, in frames of these sizes."""
        items = self._described.items
        if items is None:
            return np.zeros(len(sizes), np.int64)
        least = self._described.lengths[0] + self._uncounted
        return items.low + (sizes - least) // items.size


class _Trial:
    """Frames that are tested part by part: the first test that fails is the one that counts."""

    def __init__(self, data: Bytes, places: Numbers, sizes: Numbers, counts: Numbers) -> None:
        self._data = data
        self._places = places
        self._sizes = sizes
        self._counts = counts
        self.why: Numbers = np.full(len(places), FINE, np.int64)
        self.at: Numbers = np.zeros(len(places), np.int64)

    def refuse(self, wrong: NDArray[np.bool_], why: str, at: Numbers | int) -> None:
        """Note why frames are none, unless it is noted already."""
        if wrong.any():
            new = wrong & (self.why == FINE)
            self.why[new] = _REASONS[why]
            self.at[new] = np.broadcast_to(at, new.shape)[new]

    def count(self, slot: Slot, factor: int) -> None:
        """Test the number of elements, or of their bytes."""
        found = read_numbers(self._data, self._from_front(slot.at), slot).astype(np.int64)
        # The first byte that differs shows it: `at` tells refusals apart, not to the byte.
        self.refuse(found != self._counts * factor, "COUNT_MISMATCH", self._offset(slot.at))

    def listed(self, slot: Slot) -> None:
        """Test each element of a list."""
        tested = [field for field in slot.fields if _is_tested(field)]
        if slot.is_fixed:
            for number in range(slot.low):
                for field in tested:
                    self.part(field, slot.at + number * slot.size + field.at)
            return
        for number in range(int(self._counts.max(initial=0))):
            there = np.flatnonzero(self._counts > number)
            inside = self._chosen(there)
            for field in tested:
                inside.part(field, slot.at + number * slot.size + field.at)
            self.why[there], self.at[there] = inside.why, inside.at

    def _chosen(self, which: Numbers) -> _Trial:
        """Return the trial of some of the frames."""
        places, sizes, counts = self._places[which], self._sizes[which], self._counts[which]
        found = _Trial(self._data, places, sizes, counts)
        found.why, found.at = self.why[which], self.at[which]
        return found

    def part(self, slot: Slot, at: int) -> None:
        """Test a constant, a number or a text."""
        for wrong, offset in self._wrong(slot, at):
            self.refuse(wrong, "OUT_OF_RANGE", self._offset(at) + offset)

    def _wrong(self, slot: Slot, at: int) -> Iterator[tuple[NDArray[np.bool_], int]]:
        places = self._from_front(at)
        if slot.role == "constant":
            rows = read_blocks(self._data, places, slot.size)
            for number, byte in enumerate(slot.data):
                yield rows[:, number] != byte, number
        elif slot.role == "text":
            rows = read_blocks(self._data, places, slot.size)
            for number in range(slot.size):
                yield rows[:, number] > _HIGHEST_CHARACTER, number
        else:
            numbers = read_numbers(self._data, places, slot)
            yield (numbers < slot.low) | (numbers > slot.high), 0

    def _from_front(self, at: int) -> Numbers:
        return self._places + self._offset(at)

    def _offset(self, at: int) -> Numbers:
        """Return a place in each frame; below zero it counts from the end."""
        return np.full(len(self._sizes), at) if at >= 0 else self._sizes + at


def _is_tested(slot: Slot) -> bool:
    """Tell whether a frame may be refused for this part."""
    if slot.role in ("count", "size", "constant", "text"):
        return True
    if slot.role == "list":
        return any(_is_tested(field) for field in slot.fields)
    return slot.role == "field" and not slot.is_float and _is_narrow(slot)


def _is_narrow(slot: Slot) -> bool:
    """Tell whether fewer values are allowed than its type has."""
    bits = 8 * slot.size
    low = -(1 << bits - 1) if slot.said.get("signed") else 0
    return (slot.low, slot.high) != (low, low + (1 << bits) - 1)


def is_testable(slot: Slot) -> bool:
    """Tell whether a part of a message is one that is tested here."""
    if slot.role == "list":
        return all(map(is_testable, slot.fields))
    if slot.role == "packed":
        bits = int(slot.said["packed"][1:])
        return (slot.low, slot.high) == (0, (1 << bits) - 1)
    # Larger numbers have no room in those that are compared.
    return slot.role in ("count", "size", "constant", "reserved", "text") or (
        slot.role == "field" and (slot.size < 8 or not _is_tested(slot))
    )
