"""An id that no message has, for unknown frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.model import Model

# More ids than any protocol has messages in a row.
_TRIED = 0x1000


def unknown_id(model: Model, direction: Direction) -> int | None:
    """Return an id that no message of this direction has; None where all are taken.

    The highest such id without a byte of the header is preferred: new messages seldom take it, so
    that cases stay as they are.
    """
    slot, header = model.frame.id, set(model.frame.header)
    known = model.ids.get(direction, ())
    others = [ids for way, ids in model.ids.items() if way != direction]
    spare = None
    for number in range(slot.high, max(slot.low - 1, slot.high - _TRIED), -1):
        if (number,) in known:
            continue
        if not header & set(slot.write(number)) and not any((number,) in each for each in others):
            return number
        spare = number if spare is None else spare
    return spare
