"""Rows that are tested in turn: all that fail are shown, and there has to be one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.in_turn import in_turn

if TYPE_CHECKING:
    from pathlib import Path


@in_turn("one, other", lambda: [(1, 1), (1, 2), (3, 3), (4, 5)])
def alike(one: int, other: int) -> None:
    assert one == other


@in_turn("row", list)
def none(row: Any) -> None: ...


@in_turn("row", lambda: ["a", "b"])
def test_a_row_comes_with_fixtures(tmp_path: Path, row: str) -> None:
    (tmp_path / row).touch(exist_ok=False)


def test_each_row_that_fails_is_shown() -> None:
    with pytest.raises(AssertionError, match=r"2 of 4 rows fail\n\(1, 2\)(?s:.*)\n\(4, 5\)"):
        alike()


def test_no_rows_fail() -> None:
    with pytest.raises(AssertionError, match="there are no rows"):
        none()
