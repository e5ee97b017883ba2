"""The results of a run: one measurement for every row and contender."""

from __future__ import annotations

from dataclasses import dataclass, field

from benchmarks.sampling import Spread

FLOOR = "floor"
"""The contender that every other is divided by."""

OURS = "busservo"
AT_HAND = "busservo, message at hand"
BY_CLASS = "busservo, class known"
EVERY_FIELD = "busservo, every field read"
AS_COLUMNS = "busservo, every field read, as columns"
IN_USE = "busservo, its codec in use"
CLIENT = "busservo, its client in use"
"""The library in the plainest use of a row, and in other uses."""


DECODED = "busservo, StreamDecoder"
DICTS = "busservo, StreamDecoder and to_dict"
AS_TABLES = "busservo.tables"
"""A capture of both directions: as messages, as plain data, and as columns."""

GENERATED = "the generated library"
GENERATED_READ = "the generated library, every field read"
"""The libraries of protocols with checksums."""


class WrongResultError(Exception):
    """A contender's result differs from the floor's, so its time would mean nothing."""


@dataclass
class Results:
    """Measurements in the order in which they were measured."""

    measurements: dict[tuple[str, str], Spread | str] = field(default_factory=dict)
    """By row and contender: what was measured, or the reason why nothing was."""

    sizes: dict[str, int] = field(default_factory=dict)
    """By contender: the smallest stretch of a stream that one of its samples decoded."""

    wrong: list[str] = field(default_factory=list)
    """A sentence for every contender that was refused."""

    def spread(self, row: str, contender: str) -> Spread | None:
        """Return the measurement of a contender in a row, if there is one."""
        measured = self.measurements.get((row, contender))
        return measured if isinstance(measured, Spread) else None

    def refuse(self, row: str, contender: str, error: Exception) -> None:
        """Record that a contender failed, or gave a wrong result, and was not timed."""
        self.measurements[row, contender] = "failed"
        self.wrong.append(f"{contender}, {row}: {error}")
