"""Which headers begin a legal frame, judged at many places at once, and why others begin none.

The rules are those of the stream decoder, in the same order: the parts of a frame are tested as
they come, and the first that no legal frame can have gives the reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...recording.layout import REASON_NUMBERS
from .checksums import Checksums
from .fields import NO_KIND, judge_fields
from .heads import Heads
from .shape import Shape

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ...recording.layout import Layout
    from ..events import Bytes, Numbers

UNKNOWN_KIND = -2
"""Stands for the class of a frame that is not known, and surely is one."""

UNKNOWN_COMMAND = REASON_NUMBERS["UNKNOWN_COMMAND"]


@dataclass(frozen=True, slots=True)
class Judged:
    """What begins at some places.

    `size` is that of the frame, or what a frame of unknown command claims; 0 for a size that none
    has. `kind` is an index into all messages, and `reason` one into Reason where no frame begins.
    `either` tells which frames may be another message as well.
    """

    size: NDArray[np.int32]
    kind: NDArray[np.int16]
    reason: NDArray[np.int8]
    either: NDArray[np.bool_]


class LegalFrames:
    """The frames that are legal on a line, of messages that all have one envelope."""

    def __init__(self, messages: Sequence[Layout]) -> None:
        self.envelope = messages[0].described.envelope
        self.largest = max(each.described.largest for each in messages)
        by_ids: dict[tuple[int, ...], list[Shape]] = {}
        for each in messages:
            shapes = by_ids.setdefault(each.described.seen_ids, [])
            shapes.append(Shape(each, self.largest))
        self._shapes = [*by_ids.values()]
        self._heads = Heads(self.envelope, [*by_ids], self.largest)
        self.proves_unknown = bool(self.envelope.checksums)

    def judge(self, data: Bytes, places: Numbers) -> Judged:
        """Judge what begins at some places, each a header with the largest frame's bytes there."""
        sums = Checksums(data)
        heads = self._heads.read(data, places)
        size, reason, order = heads.size, heads.reason, heads.order
        kind = np.full(len(places), NO_KIND, np.int16)
        either = np.zeros(len(places), np.bool_)
        for (start, end), shapes in zip(heads.bounds, self._shapes, strict=True):
            if start == end:
                continue
            which = order[start:end]
            found = judge_fields(shapes, sums, places.take(which), size.take(which))
            kind[which] = found.kind
            if found.reason is not None:
                reason[which] = found.reason
            if found.either is not None:
                either[which] = found.either
        if self.proves_unknown:
            self._prove_unknown(Judged(size, kind, reason, either), data, sums, places)
        return Judged(size, kind, reason, either)

    def _prove_unknown(self, found: Judged, data: Bytes, sums: Checksums, places: Numbers) -> None:
        """Find the frames of unknown command whose checksum proves that they are frames."""
        claimed = np.flatnonzero((found.reason == UNKNOWN_COMMAND) & (found.size > 0))
        if not len(claimed):
            return
        begins, sizes = places[claimed], found.size[claimed]
        proven = (sizes >= self.envelope.body_at) & self._heads.are_around(data, begins)
        for part in self.envelope.checksums:
            proven &= sums.are_right(self.envelope, part, begins, sizes)
        found.kind[claimed[proven]] = UNKNOWN_KIND
