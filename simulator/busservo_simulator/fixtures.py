"""Fixtures for pytest: import them in a conftest.py, or name this module in `pytest_plugins`.

No plugin is registered: no pytest run should become slower for a robot that it does not test.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from framewire.simulator.clock import VirtualClock

from busservo_simulator.virtual_controller import VirtualController

if TYPE_CHECKING:
    from collections.abc import Iterator


@pytest.fixture
def virtual_controller() -> Iterator[VirtualController]:
    """Yield a board in the same process, on real time."""
    with VirtualController() as board:
        yield board


@pytest.fixture
def patient_controller() -> Iterator[VirtualController]:
    """Yield a board in the same process, whose time stands still until `advance`."""
    with VirtualController(clock=VirtualClock()) as board:
        yield board


@pytest.fixture
def virtual_tcp_controller() -> Iterator[VirtualController]:
    """Yield a board behind a TCP port of this machine: `port` is its name. On every system."""
    with VirtualController("tcp") as board:
        yield board
