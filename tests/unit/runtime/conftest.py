"""What holds for tests that start boards."""

from tests.lines.boards import no_board_refuses_anything, pytest_runtest_makereport

__all__ = ["no_board_refuses_anything", "pytest_runtest_makereport"]
