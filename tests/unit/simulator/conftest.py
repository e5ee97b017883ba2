"""A board for tests, and its host."""

from tests.lines.boards import no_board_refuses_anything, pytest_runtest_makereport
from tests.unit.runtime.simulator.conftest import board, host

__all__ = ["board", "host", "no_board_refuses_anything", "pytest_runtest_makereport"]
