"""The rows of a table one after another, in one test: for many rows that take no time each."""

import inspect
import traceback
from collections.abc import Callable, Iterable
from functools import wraps
from typing import Any

import pytest

Test = Callable[..., None]

_PARAM = type(pytest.param())
# What pytest raises where an expected error does not come is no `Exception`.
_WRONG = (Exception, pytest.fail.Exception, pytest.skip.Exception)


def in_turn(
    names: str, rows: Callable[..., Iterable[Any]], ids: Callable[[Any], str] = repr
) -> Callable[[Test], Test]:
    """Call a test with each row, and show all rows that fail, by what `ids` makes of them.

    `pytest.mark.parametrize` makes a test of each row, which costs milliseconds, and makes the
    rows in every process that the tests are shared among; this makes them where the test is run.
    A row may be a `pytest.param` with an id of its own. What `rows` takes are parameters or
    fixtures of the test. No row can be skipped, which would hide it among the others.
    """
    keys = [name.strip() for name in names.split(",")]

    def decorated(test: Test) -> Test:
        @wraps(test)
        def each(**fixtures: Any) -> None:
            failed, number = [], 0
            for number, row in enumerate(rows(**_taken(rows, fixtures)), 1):  # noqa: B007 - counted
                values, shown = _told(row, ids, alone=len(keys) == 1)
                if "capsys" in fixtures:  # What a row has printed and not read is not the next's.
                    fixtures["capsys"].readouterr()
                try:
                    test(**fixtures, **dict(zip(keys, values, strict=True)))
                except _WRONG:  # of whatever kind, the other rows come first
                    failed.append(f"{shown:.200}: {traceback.format_exc()}")
            assert number, "there are no rows"
            assert failed == [], "\n".join([f"{len(failed)} of {number} rows fail", *failed])

        whole = inspect.signature(test)
        fixtures = [each for name, each in whole.parameters.items() if name not in keys]
        each.__signature__ = whole.replace(parameters=fixtures)  # type: ignore[attr-defined]
        return each

    return decorated


def _taken(rows: Callable[..., Any], fixtures: dict[str, Any]) -> dict[str, Any]:
    """Return the fixtures that a function of rows takes; methods of Python's own take none."""
    try:
        parameters = inspect.signature(rows).parameters
    except ValueError:
        return {}
    return {name: fixtures[name] for name in parameters if name in fixtures}


def _told(row: Any, ids: Callable[[Any], str], *, alone: bool) -> tuple[Iterable[Any], str]:
    """Return the values of a row, and how it is shown."""
    if isinstance(row, _PARAM):
        assert not row.marks, f"{row}: no mark is heeded"
        return row.values, str(row.id or row.values)
    return (row,) if alone else row, ids(row)
