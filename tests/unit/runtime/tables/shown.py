"""Which protocols stand for all of them in `make test`; tests/world has the others."""

from __future__ import annotations

from typing import Any

import pytest

# A CRC; every kind of field; the one that ships; and a checksum of two sums.
SHOWN = {"crsf", "everything", "lxservo", "ubx"}


def shown(name: str, *others: Any, called: str = "") -> Any:
    """Return the parameters of a test of one protocol."""
    marks = () if name in SHOWN else (pytest.mark.slow,)
    return pytest.param(name, *others, id=called or name, marks=marks)
