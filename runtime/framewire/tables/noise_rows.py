"""Noise as rows: neighbouring noise of one reason joined, however the capture was cut."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pyarrow as pa

from ..frame.errors import Reason
from .columns import event_columns
from .schema import REASON_NAMES

if TYPE_CHECKING:
    from ..codec.noise import UnknownFrame
    from .events import NoiseRuns
    from .schema import Schemas


class NoiseRows:
    """The rows of the table of noise, of one capture; noise that may go on is held back."""

    def __init__(self, schemas: Schemas, unknown: type[UnknownFrame]) -> None:
        self._schemas = schemas
        self._unknown = unknown
        self._held: NoiseRuns | None = None

    def add(self, runs: NoiseRuns, end: int) -> pa.RecordBatch | None:
        """Take in what came next, up to the byte `end`; return the rows that are certain now."""
        joined = _joined(runs if self._held is None else self._held.then(runs))
        count = len(joined.frame)
        certain = count
        if count and joined.offset[-1] + joined.size[-1] == end:
            certain -= 1
        self._held = joined.chosen(np.arange(certain, count)) if certain < count else None
        return self._batch(joined.chosen(np.arange(certain))) if certain else None

    def end(self) -> pa.RecordBatch | None:
        """Return the last row."""
        held, self._held = self._held, None
        return None if held is None else self._batch(held)

    def _batch(self, runs: NoiseRuns) -> pa.RecordBatch:
        frames = [
            None if frame is None else self._unknown(frame, Reason.UNKNOWN_COMMAND)
            for frame in runs.frame
        ]
        numbers = [None if frame is None else frame.numbers for frame in frames]
        reasons = pa.DictionaryArray.from_arrays(
            pa.array(runs.reason.astype(np.int8)), REASON_NAMES
        )
        columns: list[pa.Array] = [
            *event_columns(self._schemas, runs),
            reasons,
            pa.array([frame is not None for frame in frames]),
        ]
        for name, (_, kind) in self._schemas.unknown_numbers.items():
            values = [None if each is None else each.get(name) for each in numbers]
            columns.append(pa.array(values, kind))
        parameters = [None if frame is None else frame.parameters for frame in frames]
        columns.append(pa.array(parameters, pa.binary()))
        return pa.RecordBatch.from_arrays(columns, schema=self._schemas.noise)


def _joined(runs: NoiseRuns) -> NoiseRuns:
    """Join noise of one reason that follows each other without anything between."""
    if len(runs.frame) < 2:
        return runs
    first = np.flatnonzero(~runs.goes_on)
    return replace(runs.chosen(first), size=np.add.reduceat(runs.size, first))
