"""Sampling: CPU time, and every sample between two samples of the floor."""

from __future__ import annotations

import statistics
import time
import timeit
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

# The collector stays on while we measure, as it is for a user; timeit would turn it off.
# What it walks is the work of the sample at hand:
# whatever was alive before, all imported peers among it, is frozen out of its sight.
_SETTLE = "import gc; gc.collect(); gc.freeze(); gc.enable()"

Sample = Callable[[int], float]
"""Takes the sample of a round: CPU seconds for one unit of work, whatever the unit of its row."""


@dataclass(frozen=True)
class Spread:
    """The median of the rounds, with the quartiles that say how far to trust it."""

    low: float
    median: float
    high: float


def spread(values: list[float]) -> Spread:
    """Return median and quartiles of at least one value."""
    if len(values) == 1:
        return Spread(values[0], values[0], values[0])
    low, median, high = statistics.quantiles(values, n=4, method="inclusive")
    return Spread(low, median, high)


def between(floor: Sample, contender: Sample, rounds: int) -> list[tuple[float, float]]:
    """Return for every round the contender's sample, and the mean of the floor's around it."""
    pairs = []
    for number in range(rounds):
        before = floor(number)
        own = contender(number)
        after = floor(number)
        pairs.append((own, (before + after) / 2))
    return pairs


def ratio(pairs: list[tuple[float, float]]) -> Spread:
    """Return the contender over the floor, taken round by round."""
    return spread([own / floor for own, floor in pairs])


def statement_seconds(
    statement: str, names: Mapping[str, Any], number: int, setup: str = ""
) -> float:
    """Return the CPU seconds that `number` runs of a statement take.

    A statement is text, as for `timeit`, so that neither side pays for a call that is not its own.
    """
    timer = timeit.Timer(
        statement,
        f"{_SETTLE}\n{setup}",
        timer=time.process_time,
        globals=dict(names),
    )
    return timer.timeit(number)


def statement_sample(statement: str, names: Mapping[str, Any], seconds: float) -> Sample:
    """Return a sample of a small statement, repeated so that one sample lasts about `seconds`."""
    number = 1
    while (taken := statement_seconds(statement, names, number)) < seconds / 4:
        number *= 4
    number = max(1, round(number * seconds / taken))
    return lambda _: statement_seconds(statement, names, number) / number
