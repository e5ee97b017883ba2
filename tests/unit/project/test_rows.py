"""The rows of a table for tests/world: each with every row of the other tables of its test."""

from types import ModuleType

import pytest

from tests.rows import Rows, each_protocol, left_out_of, some


@pytest.mark.parametrize("number", [1, 2])
@pytest.mark.parametrize(("name", "way"), Rows([("a", "up")], others=[("b", "down")]))
def pairs(number: int, name: str, way: str) -> None: ...


@pytest.mark.garbage
@pytest.mark.parametrize(
    "number", some([1, pytest.param(2, marks=pytest.mark.xfail)], lambda number: number < 2)
)
def marked(number: int) -> None: ...


def test_each_other_row_is_tried_once_with_its_marks(monkeypatch: pytest.MonkeyPatch) -> None:
    module = ModuleType("tests.test_tables")
    vars(module).update(test_pairs=pairs, test_marked=marked)
    for test in (pairs, marked):
        monkeypatch.setattr(test, "__module__", module.__name__)
    found = [*left_out_of(module)]
    both = [{"name": "b", "way": "down", "number": number} for number in (1, 2)]
    assert [row.values[0].values for row in found] == [*both, {"number": 2}]
    assert [row.values[0].test for row in found] == [pairs, pairs, marked]
    assert [[mark.name for mark in row.marks] for row in found] == [[], [], ["garbage", "xfail"]]
    assert found[0].id == "test_tables-test_pairs-b-down-1"


def test_protocols_like_others_are_the_other_rows() -> None:
    found = each_protocol(["ubx", pytest.param("sbus", 1, id="one")])
    assert ([*found], [row.id for row in found.others]) == ([pytest.param("ubx")], ["one"])
