"""Fixtures for verbs that run in this process: no other program is on their lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.lines.boards import no_board_refuses_anything, pytest_runtest_makereport
from tests.timeouts import undoubted

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["no_board_refuses_anything", "pytest_runtest_makereport"]


@pytest.fixture(autouse=True)
def _no_reply_is_doubted() -> Iterator[None]:
    with undoubted():
        yield
