"""The lowest and the highest value of each number, by what it is measured of."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..events import Numbers
    from .quantities import Quantity, Readings

# So many channels or addresses are told apart; of more, the values are taken together.
_MOST_KEYS = 512
_NARROW = 1 << 15


@dataclass(frozen=True, slots=True)
class Extremes:
    """The values of a quantity: how many, how many of them were absent, and between what they lie.

    `key` is the number of what was measured; None for a quantity that has none, or too many.
    """

    quantity: Quantity
    key: int | None
    count: int
    absent: int
    lowest: float | None
    highest: float | None


class Ranges:
    """The extremes of all quantities so far."""

    def __init__(self) -> None:
        self._found: dict[Quantity, dict[int | None, Extremes]] = {}

    def add(self, quantity: Quantity, readings: Readings) -> None:
        """Take in more values of a quantity."""
        known: dict[int | None, Extremes] = self._found.setdefault(quantity, {})
        for key, which in _by_key(quantity, readings):
            value, absent = readings.value[which], readings.absent[which]
            there = value[~absent] if absent.any() else value
            if len(known) >= _MOST_KEYS and key not in known:
                together = _merged([*known.values()])
                known.clear()
                known[None] = together
            place = None if None in known else key
            made = Extremes(
                quantity,
                place,
                len(value),
                len(value) - len(there),
                there.min().item() if len(there) else None,
                there.max().item() if len(there) else None,
            )
            known[place] = _merged([known[place], made]) if place in known else made

    def __iter__(self) -> Iterator[Extremes]:
        """Yield all of them, message by message, and those of a quantity by key."""
        for _, known in sorted(self._found.items(), key=lambda item: item[0].place):
            yield from (each for _, each in sorted(known.items(), key=lambda item: item[0] or 0))


def _by_key(quantity: Quantity, readings: Readings) -> Iterator[tuple[int | None, Numbers | slice]]:
    """Yield which values belong to each key."""
    key = readings.key
    if not len(key):
        return
    if quantity.key is None:
        yield None, slice(None)
        return
    if key.min() >= 0 and key.max() < _NARROW:
        key = key.astype(np.int16)  # sorted by its bytes, not by comparing
    order = np.argsort(key, kind="stable")
    ordered = key[order]
    begins = np.flatnonzero(np.concatenate(([True], ordered[1:] != ordered[:-1])))
    for start, end in pairwise([*begins.tolist(), len(order)]):
        yield int(ordered[start]), order[start:end]


def _merged(some: list[Extremes]) -> Extremes:
    """Return what holds of all of them together."""
    low = [each.lowest for each in some if each.lowest is not None]
    high = [each.highest for each in some if each.highest is not None]
    key = some[0].key if len({each.key for each in some}) == 1 else None
    return Extremes(
        some[0].quantity,
        key,
        sum(each.count for each in some),
        sum(each.absent for each in some),
        min(low, default=None),
        max(high, default=None),
    )
