"""The tables of a capture, held in memory: a mapping from their names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

import pyarrow as pa

if TYPE_CHECKING:
    from .reader import Batches
    from .schema import Schemas


class Tables(Mapping[str, pa.Table]):
    """The tables of a capture by name: one a message, and `noise`.

    All are there, also of messages that the capture does not hold: these have no rows. What has
    rows is in `filled`.
    """

    def __init__(self, tables: Mapping[str, pa.Table]) -> None:
        self._tables = dict(tables)

    def __getitem__(self, name: str) -> pa.Table:
        try:
            return self._tables[name]
        except KeyError:
            raise KeyError(f"{name!r} is no table; there are {', '.join(self._tables)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._tables)

    def __len__(self) -> int:
        return len(self._tables)

    @property
    def filled(self) -> dict[str, pa.Table]:
        """The tables that have rows."""
        return {name: table for name, table in self._tables.items() if table.num_rows}

    def __repr__(self) -> str:
        rows = ", ".join(f"{name}: {table.num_rows}" for name, table in self.filled.items())
        return f"{type(self).__name__}({rows or 'no rows'})"

    def _repr_html_(self) -> str:
        """Return the names and rows as a small table, for notebooks."""
        rows = "".join(
            f"<tr><td>{name}</td><td>{table.num_rows}</td></tr>"
            for name, table in self.filled.items()
        )
        return f"<table><tr><th>table</th><th>rows</th></tr>{rows}</table>"


def gathered(schemas: Schemas, batches: Iterable[Batches]) -> Tables:
    """Return all batches, table by table."""
    every = schemas.every()
    parts: dict[str, list[pa.RecordBatch]] = {name: [] for name in every}
    for made in batches:
        for name, batch in made.items():
            parts[name].append(batch)
    return Tables(
        {name: pa.Table.from_batches(parts[name], schema=schema) for name, schema in every.items()}
    )
