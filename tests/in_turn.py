"""The rows of a table one after another, in one test: for many rows that take no time each."""

from __future__ import annotations

import inspect
import traceback
from functools import wraps
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    Test = Callable[..., None]


def in_turn(names: str, rows: Callable[[], Iterable[Any]]) -> Callable[[Test], Test]:
    """Call a test with each row, and show all rows that fail.

    `pytest.mark.parametrize` makes a test of each row, which costs milliseconds, and makes the
    rows in every process that the tests are shared among; this makes them where the test is run.
    """
    keys = [name.strip() for name in names.split(",")]

    def decorated(test: Test) -> Test:
        @wraps(test)
        def each(**fixtures: Any) -> None:
            failed, number = [], 0
            for number, row in enumerate(rows(), 1):  # noqa: B007 - counted
                values = row if len(keys) > 1 else (row,)
                try:
                    test(**fixtures, **dict(zip(keys, values, strict=True)))
                except Exception:  # noqa: BLE001 - of whatever kind, the other rows come first
                    failed.append(f"{row!r:.200}: {traceback.format_exc()}")
            assert number, "there are no rows"
            assert failed == [], "\n".join([f"{len(failed)} of {number} rows fail", *failed])

        whole = inspect.signature(test)
        fixtures = [each for name, each in whole.parameters.items() if name not in keys]
        each.__signature__ = whole.replace(parameters=fixtures)  # type: ignore[attr-defined]
        return each

    return decorated
