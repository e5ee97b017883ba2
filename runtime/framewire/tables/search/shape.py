"""Which parts of a message are tested, and how many elements frames of each size have."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...protocol.slots import Constant, List, Number, Packed, Text

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...protocol.slots import Slot
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
            size = length + self._described.envelope.uncounted
            self._counts[size] = self._described.count_at(length)

    def counts(self, sizes: NDArray[np.int32]) -> NDArray[np.int32]:
        """Return how many elements the list has in frames of these sizes; -1 where none has it."""
        return self._counts.take(sizes)

    def judge(self, trial: Trial) -> None:
        """Test each part of frames; what is found out counts for legal sizes alone."""
        items, frame = self._described.items, self._described.envelope
        for slot in self._tested:
            match slot:
                case Number(is_counted=True) if items is not None:
                    trial.count(slot, items.size if slot.role == "size" else 1)
                case List():
                    trial.listed(slot, [field for field in slot.fields if is_tested(field)])
                case Number(optional=True):
                    trial.optional(slot, frame.least - frame.body_at)
                case Number() | Constant() | Text():
                    trial.part(slot, slot.at)
        for part in frame.checksums:
            trial.checksum(frame, part)


def is_tested(slot: Slot) -> bool:
    """Tell whether a frame may be refused for this part."""
    match slot:
        case Constant():
            return slot.role == "constant"
        case List():
            return any(is_tested(field) for field in slot.fields)
        case Number():
            return slot.is_counted or (slot.role == "field" and _is_narrow(slot))
        case _:
            return isinstance(slot, Text)


def _is_narrow(number: Number) -> bool:
    """Tell whether fewer values are allowed than its type has."""
    bits = 8 * number.size
    low = -(1 << bits - 1) if number.signed else 0
    return not number.is_float and (number.low, number.high) != (low, low + (1 << bits) - 1)


def is_testable(slot: Slot) -> bool:
    """Tell whether a part of a message is one that is tested here."""
    match slot:
        case List():
            return all(map(is_testable, slot.fields))
        case Packed():
            return (slot.low, slot.high) == (0, (1 << slot.bits) - 1)
        case Number(role="field"):
            # Larger numbers have no room in those that are compared.
            return slot.size < 8 or not is_tested(slot)
        case _:
            return True
