"""Tables of which `make test` tries some rows; tests/world/test_rows.py tries the others."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import product
from types import ModuleType
from typing import Any, NamedTuple

import pytest

# Protocols of which each kind of frame, or what is odd in it, is one of another as well.
ALIKE = {*("crsf", "dynamixel1", "ibus", "mavlink1", "mhz19", "msp", "sbus", "tfmini", "visca")}
_PARAM = type(pytest.param())


class Rows(list[Any]):
    """The rows of a table that are tried where it is, and the `others`, which are slow."""

    def __init__(self, here: Iterable[Any], others: Iterable[Any]) -> None:
        super().__init__(here)
        self.others = [*others]


def some(table: Iterable[Any], is_quick: Callable[..., bool]) -> Rows:
    """Return a table of which only the rows with values that are quick are tried where it is."""
    rows = [row if isinstance(row, _PARAM) else pytest.param(row) for row in table]
    quick = [row for row in rows if is_quick(*row.values)]
    return Rows(quick, [row for row in rows if row not in quick])


def each_protocol(table: Iterable[Any]) -> Rows:
    """Return rows that each begin with a protocol; those of protocols like others are slow."""
    return some(table, lambda name, *_: getattr(name, "stem", name) not in ALIKE)


class Row(NamedTuple):
    """A test, and the values of some of its parameters."""

    test: Any
    values: dict[str, Any]


def left_out_of(module: ModuleType) -> Iterator[Any]:
    """Yield the other rows of the tables in a module, as parameters of one test."""
    stem = module.__name__.rpartition(".")[2]
    for name, test in vars(module).items():
        if name.startswith("test_") and getattr(test, "__module__", "") == module.__name__:
            marks = [mark for each in (module, test) for mark in _marks(each.__dict__)]
            tables = [_table(mark) for mark in marks if mark.name == "parametrize"]
            for parts in product(*tables):
                values = {key: value for part, _, _ in parts for key, value in part.items()}
                if any(is_other for _, _, is_other in parts):
                    others = [mark for mark in marks if mark.name != "parametrize"]
                    others += [mark for _, own, _ in parts for mark in own]
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


def _table(mark: pytest.Mark) -> list[tuple[dict[str, Any], list[pytest.Mark], bool]]:
    """Return all rows of a table, each with the marks of its own and whether it is another."""
    names, rows = mark.args
    keys = [each.strip() for each in names.split(",")] if isinstance(names, str) else [*names]
    both = [(row, False) for row in rows] + [(row, True) for row in getattr(rows, "others", [])]
    params = (
        (
            row if isinstance(row, _PARAM) else pytest.param(*(row if keys[1:] else [row])),
            is_other,
        )
        for row, is_other in both
    )
    return [
        (
            dict(zip(keys, each.values, strict=True)),
            _marks({"pytestmark": [*each.marks]}),
            is_other,
        )
        for each, is_other in params
    ]
