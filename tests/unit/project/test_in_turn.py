"""Rows that are tested in turn: all that fail are shown, and there has to be one."""

from pathlib import Path
from typing import Any

import pytest

from tests.in_turn import in_turn


@in_turn("one, other", lambda: [(1, 1), (1, 2), (3, 3), (4, 5)])
def alike(one: int, other: int) -> None:
    assert one == other


@in_turn("row", list)
def none(row: Any) -> None: ...


@in_turn("row", lambda: ["a", "b"])
def test_a_row_comes_with_fixtures(tmp_path: Path, row: str) -> None:
    (tmp_path / row).touch(exist_ok=False)


@in_turn("row", lambda: ["a", "b"])
def test_what_a_row_prints_is_its_own(capsys: pytest.CaptureFixture[str], row: str) -> None:
    print(row)
    if row == "b":
        assert capsys.readouterr().out == "b\n"


def test_each_row_that_fails_is_shown() -> None:
    with pytest.raises(AssertionError, match=r"2 of 4 rows fail\n\(1, 2\)(?s:.*)\n\(4, 5\)"):
        alike()


@in_turn("text", lambda: ["1", "no", "2", "skipped"])
def numbers(text: str) -> None:
    if text == "skipped":
        pytest.skip("for want of something")
    with pytest.raises(ValueError, match="invalid"):
        int(text)


@in_turn("one, other", lambda: [pytest.param(1, 2, id="the first"), pytest.param(2, 2)])
@in_turn("third", lambda one: [one, one + 1], ids=lambda third: f"and {third}")
def sums(one: int, other: int, third: int) -> None:
    assert one + other != third + 2


def test_no_row_hides_others_that_raises_nothing_or_is_skipped() -> None:
    with pytest.raises(AssertionError, match="3 of 4 rows fail") as raised:
        numbers()
    rows = [line for line in str(raised.value).splitlines() if line.startswith("'")]
    assert [row.partition(":")[0] for row in rows] == ["'1'", "'2'", "'skipped'"]
    assert "DID NOT RAISE" in str(raised.value)
    assert "for want of something" in str(raised.value)


def test_tables_in_tables_show_a_row_of_each_by_its_name() -> None:
    with pytest.raises(AssertionError, match="2 of 2 rows fail") as raised:
        sums()
    lines = str(raised.value).splitlines()
    names = [line.partition(":")[0] for line in lines if line.startswith(("the", "(2, 2)", "and"))]
    assert names == ["the first", "and 1", "(2, 2)", "and 2"]


def test_no_rows_fail() -> None:
    with pytest.raises(AssertionError, match="there are no rows"):
        none()
