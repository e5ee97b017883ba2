"""The libraries of the protocols, made once for all tests of a module."""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest

from tests.protocols.libraries import Libraries


@pytest.fixture(scope="module")
def libraries() -> Iterator[Libraries]:
    """Return the library of each protocol, by the name of its file."""
    with ExitStack() as until:
        yield Libraries(until)
