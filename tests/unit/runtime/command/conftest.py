"""Fixtures for verbs that run in this process: no other program is on their lines."""

from collections.abc import Iterator

import pytest
from busservo_simulator import VirtualController

from tests.timeouts import undoubted


@pytest.fixture
def board() -> Iterator[VirtualController]:
    """Yield a board with three servos."""
    with VirtualController("tcp", servos=[1, 2, 3]) as board:
        yield board


@pytest.fixture(autouse=True)
def _no_reply_is_doubted() -> Iterator[None]:
    with undoubted():
        yield
