"""Fixtures for every test of the writer."""

import os

import pytest


@pytest.fixture(autouse=True)
def no_power_fails(monkeypatch: pytest.MonkeyPatch) -> None:
    """Skip waiting for the disk: it takes long, and matters only when the power fails."""
    monkeypatch.setattr(os, "fsync", lambda _descriptor: None)
