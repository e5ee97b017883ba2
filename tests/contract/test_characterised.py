"""Libraries do what is written down of them while their runtime moves: tests/characterise.py."""

from __future__ import annotations

import sys

import pytest

from tests.characterise import SPECS, differing
from tests.rows import some

# The other that ships, and those of the tests, are slow.
SHOWN = {"busservo"}
# What is written down names ports as Linux does.
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ports have other names there")


@pytest.mark.parametrize("name", some(SPECS, lambda name: name in SHOWN))
def test_it_does_what_is_written_down(name: str) -> None:
    rows = differing(name)
    assert rows == [], (
        f"to see why: python -m tests.characterise --texts build/new {name}, the same with "
        "build/old in a checkout of the commit that last wrote down what it does, and diff -r"
    )
