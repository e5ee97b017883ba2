"""What holds for every test of the writer."""

from __future__ import annotations

import os

import pytest


@pytest.fixture(autouse=True)
def no_power_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """To wait for the disk takes long, and makes a difference only to those who pull the plug."""
    monkeypatch.setattr(os, "fsync", lambda _descriptor: None)
