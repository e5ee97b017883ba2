"""The parts behind the heads of frames, tested in many frames at once."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ...protocol.slots import Constant, Text
from ...recording.layout import REASON_NUMBERS
from ..places import read_blocks, read_numbers
from .heads import FINE

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from ...protocol.envelope import Envelope
    from ...protocol.slots import Element, List, Number
    from ..events import Numbers
    from .checksums import Checksums

_HIGHEST_CHARACTER = 0x7F


@dataclass(eq=False)
class Trial:
    """Frames that are tested part by part; `is_wrong` tells which of them are none.

    They begin at some places, and have these sizes, and so many elements of a list.
    """

    sums: Checksums
    places: Numbers
    sizes: NDArray[np.int32]
    counts: NDArray[np.int32]
    is_wrong: NDArray[np.bool_] = field(init=False)

    def __post_init__(self) -> None:
        """Begin with frames of which nothing is wrong."""
        self.is_wrong = np.zeros(len(self.places), np.bool_)

    def refuse(self, wrong: NDArray[np.bool_], _why: str, _at: NDArray[np.int32] | int, /) -> None:
        """Note which frames are none."""
        self.is_wrong |= wrong

    def count(self, slot: Number, factor: int) -> None:
        """Test the number of elements, or of their bytes."""
        found = read_numbers(self.sums.data, self._begins(slot.at), slot)
        due = self.counts if factor == 1 else self.counts * factor
        self.refuse(found != due, "COUNT_MISMATCH", self._offset(slot.at))

    def listed(self, slot: List, tested: Sequence[Element]) -> None:
        """Test some of what each element of a list holds."""
        most = slot.low if slot.is_fixed else int(self.counts.max(initial=0))
        for number in range(most):
            there = True if slot.is_fixed else self.counts > number
            for each in tested:
                self.part(each, slot.at + number * slot.size + each.at, there)

    def optional(self, slot: Number, tail: int) -> None:
        """Test a number in those frames that do not end before it; `tail` bytes are behind."""
        self.part(slot, slot.at, self.sizes - tail >= slot.at + slot.size)

    def part(self, slot: Element, at: int, there: NDArray[np.bool_] | bool = True) -> None:
        """Test a constant, a number or a text, in those frames that have it."""
        for wrong, offset in self._wrong(slot, at):
            self.refuse(wrong & there, "OUT_OF_RANGE", self._offset(at) + offset)

    def checksum(self, envelope: Envelope, part: Number) -> None:
        """Test a checksum at the end."""
        right = self.sums.are_right(envelope, part, self.places, self.sizes)
        self.refuse(~right, "BAD_CHECKSUM", self.sizes + part.at)

    def _wrong(self, slot: Element, at: int) -> Iterator[tuple[NDArray[np.bool_], int]]:
        """Yield which frames have something else there, and at which byte of the part."""
        data, places = self.sums.data, self._begins(at)
        if isinstance(slot, Constant):
            rows = read_blocks(data, places, slot.size)
            for number, byte in enumerate(slot.data):
                yield rows[:, number] != byte, number
        elif isinstance(slot, Text):
            rows = read_blocks(data, places, slot.size)
            for number in range(slot.size):
                yield rows[:, number] > _HIGHEST_CHARACTER, number
        else:
            numbers = read_numbers(data, places, slot)
            yield (numbers < slot.low) | (numbers > slot.high), 0

    def _begins(self, at: int) -> Numbers:
        """Return where a part begins in each frame; below zero it counts from the end."""
        return self.places + self._offset(at)

    def _offset(self, at: int) -> NDArray[np.int32] | int:
        return at if at >= 0 else self.sizes + at


@dataclass(eq=False)
class ReasonedTrial(Trial):
    """A trial that also tells why: the first test that fails is the one that counts.

    `why` says why each is none, or FINE; and `at` is the byte at which that shows.
    """

    why: NDArray[np.int8] = field(init=False)
    at: NDArray[np.int32] = field(init=False)

    def __post_init__(self) -> None:
        """Begin with frames of which nothing is wrong."""
        super().__post_init__()
        self.why = np.full(len(self.places), FINE, np.int8)
        self.at = np.zeros(len(self.places), np.int32)

    def refuse(self, wrong: NDArray[np.bool_], why: str, at: NDArray[np.int32] | int, /) -> None:
        """Note why frames are none, unless it is noted already."""
        new = wrong & ~self.is_wrong
        self.why[new] = REASON_NUMBERS[why]
        self.at[new] = at if isinstance(at, int) else at[new]
        self.is_wrong |= wrong
