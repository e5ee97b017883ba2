"""The rows that `make test` leaves out of its tables, such as protocols that are like others."""

import inspect
import re
from importlib import import_module
from pathlib import Path

import pytest

from tests.contract.protocols.conftest import libraries
from tests.lines.boards import no_board_refuses_anything
from tests.rows import Row, left_out_of
from tests.unit.runtime.tables.test_dataset import captures
from tests.unit.writing.test_generate import project

__all__ = ["captures", "libraries", "no_board_refuses_anything", "project"]

ROOT = Path(__file__).parents[2]
HAS_SOME = re.compile(r"^from tests\.rows import ", re.MULTILINE)
MODULES = [
    ".".join(file.relative_to(ROOT).with_suffix("").parts)
    for file in sorted((ROOT / "tests").rglob("test_*.py"))
    if file.parent != Path(__file__).parent and HAS_SOME.search(file.read_text(encoding="utf-8"))
]
ROWS = [row for name in MODULES for row in left_out_of(import_module(name))]


@pytest.mark.parametrize("row", ROWS)
def test_it_holds_for_the_other_rows(row: Row, request: pytest.FixtureRequest) -> None:
    asked = set(inspect.signature(row.test).parameters) - set(row.values)
    row.test(**{name: request.getfixturevalue(name) for name in asked}, **row.values)
