"""The libraries of the protocols, made once for all tests of a module."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING

import pytest

from tests.protocols.libraries import Libraries

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture(scope="module")
def libraries() -> Iterator[Libraries]:
    """Return the library of each protocol, by the name of its file."""
    with ExitStack() as until:
        yield Libraries(until)
