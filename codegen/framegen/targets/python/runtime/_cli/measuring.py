"""Statistics and traces of a recording, for `stats`: apart, since they need the extra `tables`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._tables.stats.statistics import Statistics, statistics
from .._tables.stats.traces import Traces

if TYPE_CHECKING:
    from .._frame.direction import Direction
    from .recording import Recording


def measured(
    recording: Recording, form: str, direction: Direction | None, baud: float | None
) -> tuple[Statistics, Traces | None]:
    """Return what a recording holds; with a rate of the line, also the traces of its readings."""
    traces = None if baud is None else Traces(baud)
    return statistics(recording, form=form, direction=direction, traces=traces), traces
