"""Libraries do what is written down of them while their runtime moves: tests/characterise.py."""

from __future__ import annotations

import sys

import pytest

from tests.characterise import SPECS, differing

# One that ships, with positions; one of many devices; every kind of field; a bare checksum.
SHOWN = {"busservo", "lxservo", "everything", "roboclaw"}
# What is written down names ports as Linux does.
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ports have other names there")


@pytest.mark.parametrize(
    "name",
    [each if each in SHOWN else pytest.param(each, marks=pytest.mark.slow) for each in SPECS],
)
def test_it_does_what_is_written_down(name: str) -> None:
    rows = differing(name)
    assert rows == [], (
        f"to see why: python -m tests.characterise --texts build/new {name}, the same with "
        "build/old in a checkout of the commit that last wrote down what it does, and diff -r"
    )
