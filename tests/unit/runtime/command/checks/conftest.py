"""What shortens tests in real time, and libraries."""

from collections.abc import Iterator

import pytest
from framewire.command.checks import silence

from tests.contract.protocols.conftest import libraries
from tests.timeouts import undoubted

__all__ = ["libraries"]


@pytest.fixture(autouse=True)
def _no_reply_is_doubted() -> None:
    """Have replies doubted here, other than by the verbs: the doctor tells of doubt."""


@pytest.fixture
def nothing_else_comes(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Shorten the waits for what a board may send besides its replies."""
    monkeypatch.setattr(silence, "_LISTENING", 0.001)
    with undoubted():
        yield
