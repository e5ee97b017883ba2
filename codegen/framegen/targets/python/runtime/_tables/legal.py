"""Which headers begin a legal frame, judged at many places at once, and why others begin none.

The rules are those of the stream decoder, in the same order: the parts of a frame are tested as
they come, and the first that no legal frame can have gives the reason.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from .._frame.errors import Reason
from .found import UNKNOWN_SENDER
from .heads import FINE, Heads
from .shape import Shape
from .sums import Sums

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .found import Bytes, Numbers
    from .layout import Layout

NO_KIND = -1
UNKNOWN_KIND = -2
"""Stand for the class of what is no frame, and of a frame that is proven and not known."""

_REASONS = {reason.name: number for number, reason in enumerate(Reason)}
UNKNOWN_COMMAND = _REASONS["UNKNOWN_COMMAND"]


@dataclass(frozen=True, slots=True)
class Judged:
    """What begins at some places.

    `size` is that of the frame, or what a frame of unknown command claims; 0 for a size that none
    has. `kind` is an index into MESSAGES, and `reason` one into Reason where no frame begins.
    """

    size: Numbers
    kind: Numbers
    direction: Numbers
    reason: Numbers


class LegalFrames:
    """The frames that are legal on a line, of messages that all have one envelope."""

    def __init__(self, messages: Sequence[Layout]) -> None:
        self.envelope = messages[0].described.frame
        self.largest = max(each.described.largest for each in messages)
        by_ids: dict[tuple[int, ...], list[Shape]] = {}
        for each in messages:
            by_ids.setdefault(each.described.seen_ids, []).append(Shape(each))
        self._shapes = [*by_ids.values()]
        self._heads = Heads(self.envelope, [*by_ids], self.largest)
        self.proves_unknown = bool(self.envelope.checksums)

    def judge(self, data: Bytes, places: Numbers) -> Judged:
        """Judge what begins at some places, each a header with the largest frame's bytes there."""
        sums = Sums(data)
        size, reason, groups = self._heads.read(data, places)
        kind = np.full(len(places), NO_KIND, np.int64)
        direction = np.full(len(places), UNKNOWN_SENDER, np.int64)
        found = Judged(size, kind, direction, reason)
        for which, shapes in zip(groups, self._shapes, strict=True):
            if len(which):
                _judge_fields(found, sums, places, which, shapes)
        if self.proves_unknown:
            self._prove_unknown(found, sums, places)
        return found

    def _prove_unknown(self, found: Judged, sums: Sums, places: Numbers) -> None:
        """Find the frames of unknown command whose checksum proves that they are frames."""
        claimed = np.flatnonzero((found.reason == UNKNOWN_COMMAND) & (found.size > 0))
        if not len(claimed):
            return
        begins, sizes = places[claimed], found.size[claimed]
        proven = sizes >= self.envelope.body_at
        for part in self.envelope.checksums:
            proven &= sums.are_right(self.envelope, part, begins, sizes)
        found.kind[claimed[proven]] = UNKNOWN_KIND


def _judge_fields(
    found: Judged, sums: Sums, places: Numbers, which: Numbers, shapes: Sequence[Shape]
) -> None:
    """Judge what follows the head of frames with the same ids."""
    begins, sizes = places[which], found.size[which]
    reason = np.full(len(which), _REASONS["LENGTH_MISMATCH"])
    furthest = np.full(len(which), -1)
    kind = np.full(len(which), NO_KIND, np.int64)
    direction = np.full(len(which), UNKNOWN_SENDER, np.int64)
    for shape in shapes:
        fitting = np.flatnonzero(shape.fits(sizes))
        if not len(fitting):
            continue
        why, at = shape.judge(sums, begins[fitting], sizes[fitting])
        is_legal = why == FINE
        legal = fitting[is_legal]
        is_first = kind[legal] == NO_KIND
        first = legal[is_first]
        kind[first], direction[first] = shape.kind, shape.direction
        # What may be another message as well may come from either end.
        direction[legal[~is_first]] = UNKNOWN_SENDER
        if len(legal) == len(fitting):
            continue
        wrong, why, at = fitting[~is_legal], why[~is_legal], at[~is_legal]
        further = at > furthest[wrong]
        reason[wrong[further]], furthest[wrong[further]] = why[further], at[further]
    found.kind[which], found.direction[which] = kind, direction
    found.reason[which] = np.where(kind == NO_KIND, reason, FINE)
