"""Ids that no message has, for unknown frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.model import Model
    from framegen.model.slots import Number

# More ids than any protocol has messages in a row.
_TRIED = 0x1000


def unknown_id(model: Model, direction: Direction, frame: Envelope, part: Number) -> int | None:
    """Return what no message of this direction has in an id part; None where all are taken.

    The highest such id without a byte of the header is preferred: new messages seldom take it, so
    that cases stay as they are.
    """
    header = set(frame.header)
    known = _taken(model, direction, frame, part)
    others = [_taken(model, way, frame, part) for way in model.directions if way != direction]
    spare = None
    for number in range(part.high, max(part.low - 1, part.high - _TRIED), -1):
        if number in known:
            continue
        if not header & set(part.write(number)) and not any(number in each for each in others):
            return number
        spare = number if spare is None else spare
    return spare


def _taken(model: Model, direction: Direction, frame: Envelope, part: Number) -> frozenset[int]:
    found = (each for each in model.candidates([direction]) if each.frame is frame)
    return next((each.taken(part) for each in found), frozenset())
