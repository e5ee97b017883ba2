"""What follows the heads of frames with the same ids, judged as each message that it may be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ...recording.layout import REASON_NUMBERS
from .heads import FINE
from .trial import ReasonedTrial, Trial

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ..events import Numbers
    from .checksums import Checksums
    from .shape import Shape

NO_KIND = -1
"""Stands for the class of what is no frame."""

_LENGTH_MISMATCH = REASON_NUMBERS["LENGTH_MISMATCH"]


@dataclass(frozen=True, slots=True)
class Verdicts:
    """The class of each frame, NO_KIND for what is none.

    `reason` says why not, None if each is one. `either` tells which may be another message as well,
    None if none may.
    """

    kind: NDArray[np.int16]
    reason: NDArray[np.int8] | None
    either: NDArray[np.bool_] | None


def judge_fields(
    shapes: Sequence[Shape], sums: Checksums, places: Numbers, sizes: NDArray[np.int32]
) -> Verdicts:
    """Judge frames that begin at some places, as the first of some messages that they can be."""
    kind = np.full(len(places), NO_KIND, np.int16)
    either: NDArray[np.bool_] | None = None
    for shape in shapes:
        counts = shape.counts(sizes)
        trial = Trial(sums, places, sizes, counts)
        shape.judge(trial)
        is_legal = ~trial.is_wrong & (counts >= 0)
        is_other = kind != NO_KIND
        if is_other.any():
            both = is_legal & is_other
            either = both if either is None else either | both
            is_legal &= ~is_other
        kind[is_legal] = shape.kind
    lost = np.flatnonzero(kind == NO_KIND)
    if not len(lost):
        return Verdicts(kind, None, either)
    reason = np.full(len(places), FINE, np.int8)
    reason[lost] = _reasons(shapes, sums, places[lost], sizes[lost])
    return Verdicts(kind, reason, either)


def _reasons(
    shapes: Sequence[Shape], sums: Checksums, places: Numbers, sizes: NDArray[np.int32]
) -> NDArray[np.int8]:
    """Return why frames are none of some messages.

    Of several refusals the one that shows last is given, and of these the first.
    """
    reason = np.full(len(places), _LENGTH_MISMATCH, np.int8)
    furthest = np.full(len(places), -1, np.int32)
    for shape in shapes:
        counts = shape.counts(sizes)
        trial = ReasonedTrial(sums, places, sizes, counts)
        shape.judge(trial)
        is_further = (counts >= 0) & (trial.at > furthest)
        reason[is_further] = trial.why[is_further]
        furthest[is_further] = trial.at[is_further]
    return reason
