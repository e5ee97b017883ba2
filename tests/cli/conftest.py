"""What holds for the tests of verbs that are run in this process: nobody else is on their lines."""

from __future__ import annotations

import pytest
from busservo import session
from busservo.settling import Settling


@pytest.fixture(autouse=True)
def _nothing_settles(monkeypatch: pytest.MonkeyPatch) -> None:
    """A verb asks at once: replies to whoever asked before it are none of these tests' business."""

    def settled(seconds: float | None, opened_at: float) -> Settling:
        return Settling(0 if seconds is None else seconds, opened_at)

    monkeypatch.setattr(session, "Settling", settled)
