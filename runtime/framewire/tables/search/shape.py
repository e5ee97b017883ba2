"""Which parts of a message are tested, and how many elements frames of each size have."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...explain.protocol import Slot
    from ...recording.layout import Layout
    from .trial import Trial


class Shape:
    """The tests that a frame of a message must pass behind its head."""

    def __init__(self, layout: Layout, largest: int) -> None:
        self._described = layout.described
        self.kind = layout.number
        self._tested = [slot for slot in self._described.fields if is_tested(slot)]
        # How many elements the list has in a frame of each size; -1 for a size that none has.
        self._counts = np.full(largest + 1, -1, np.int32)
        lengths = self._described.lengths
        for length in lengths:
            size = length + self._described.frame.uncounted
            self._counts[size] = self._described.count_at(length)

    def counts(self, sizes: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return how many elements the list has in frames of these sizes; -1 where none has it."""
        return self._counts.take(sizes)

    def judge(self, trial: Trial) -> None:
        """Test each part of frames; what is found out counts for legal sizes alone."""
        items, frame = self._described.items, self._described.frame
        for slot in self._tested:
            if slot.role in ("count", "size") and items is not None:
                trial.count(slot, items.size if slot.role == "size" else 1)
            elif slot.role == "list":
                trial.listed(slot, [field for field in slot.fields if is_tested(field)])
            elif slot.said.get("optional"):
                trial.optional(slot, frame.least - frame.body_at)
            else:
                trial.part(slot, slot.at)
        for part in frame.checksums:
            trial.checksum(frame, part)


def is_tested(slot: Slot) -> bool:
    """Tell whether a frame may be refused for this part."""
    if slot.role in ("count", "size", "constant", "text"):
        return True
    if slot.role == "list":
        return any(is_tested(field) for field in slot.fields)
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
        slot.role == "field" and (slot.size < 8 or not is_tested(slot))
    )
