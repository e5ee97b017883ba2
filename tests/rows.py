"""Rows that `make test` leaves out of its tables, each marked `slow`; tests/world has them."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING, Any, NamedTuple

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from types import ModuleType

# Protocols of which each kind of frame, or what is odd in it, is one of another as well.
ALIKE = {
    *("crsf", "dynamixel1", "ibus", "learm", "mavlink1", "mhz19", "msp", "sbus", "tfmini", "visca")
}
_PARAM = type(pytest.param())
# What makes a row; other marks say what goes for it.
_OURS = {"parametrize", "slow"}


class Row(NamedTuple):
    """A test, and the values of some of its parameters."""

    test: Any
    values: dict[str, Any]


def each_protocol(table: Iterable[Any]) -> list[Any]:
    """Return rows that each begin with a protocol; those of protocols like others are slow."""
    rows = [row if isinstance(row, _PARAM) else pytest.param(row) for row in table]
    return [
        pytest.param(*row.values, id=row.id, marks=[*row.marks, pytest.mark.slow])
        if getattr(row.values[0], "stem", row.values[0]) in ALIKE
        else row
        for row in rows
    ]


def left_out_of(module: ModuleType) -> Iterator[Any]:
    """Yield the rows of a module that are left out, as parameters of one test."""
    stem = module.__name__.rpartition(".")[2]
    for name, test in vars(module).items():
        if name.startswith("test_") and getattr(test, "__module__", "") == module.__name__:
            marks = [mark for each in (module, test) for mark in _marks(each.__dict__)]
            for parts in product(*(_table(each) for each in marks if each.name == "parametrize")):
                values = {key: value for part, _ in parts for key, value in part.items()}
                whole = [*marks, *(mark for _, own in parts for mark in own)]
                if "slow" in {each.name for each in whole}:
                    others = [each for each in whole if each.name not in _OURS]
                    yield pytest.param(
                        Row(test, values),
                        marks=[getattr(pytest.mark, m.name)(*m.args, **m.kwargs) for m in others],
                        id="-".join([stem, name, *map(_shown, values.values())]),
                    )


def _shown(value: Any) -> str:
    return str(getattr(value, "stem", value))[:40]


def _marks(names: Mapping[str, Any]) -> list[pytest.Mark]:
    """Return the marks of a module or a test: one of them, or a list."""
    found = names.get("pytestmark", [])
    several: list[Any] = found if isinstance(found, list) else [found]
    return [getattr(each, "mark", each) for each in several]


def _table(mark: pytest.Mark) -> list[tuple[dict[str, Any], list[pytest.Mark]]]:
    """Return the rows of a table, each with the marks of its own."""
    names, rows = mark.args
    keys = [each.strip() for each in names.split(",")] if isinstance(names, str) else [*names]
    params = (
        row if isinstance(row, _PARAM) else pytest.param(*(row if keys[1:] else [row]))
        for row in rows
    )
    return [
        (dict(zip(keys, each.values, strict=True)), _marks({"pytestmark": [*each.marks]}))
        for each in params
    ]
