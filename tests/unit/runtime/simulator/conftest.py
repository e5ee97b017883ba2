"""Boards for tests, by each kind of port."""

from __future__ import annotations

import sys
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import busservo
import pytest
from busservo import ActionGroupStopped, BatteryVoltage, BatteryVoltageRead, ServoPositions
from busservo._library import LINK
from busservo_simulator import VirtualController

from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host, host_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# A question, its reply, and reports of the board's own.
ASK, VOLTAGE, STOPPED = BatteryVoltageRead(), BatteryVoltage(7500), ActionGroupStopped()
SIX = ServoPositions([(servo_id, 500) for servo_id in range(1, 7)])
WAYS = ["memory", "tcp"] if sys.platform == "win32" else ["memory", "tcp", "pty"]


@pytest.fixture
def board() -> Iterator[VirtualController]:
    """Yield a board whose time goes on when somebody waits for it, and never by itself."""
    with virtual_board() as board:
        yield board


@pytest.fixture
def host(board: VirtualController) -> Host:
    """Return a host of that board."""
    return host_of(board)


def host_at(board: VirtualController, baud: float = LINK.baud) -> Host:
    """Return a host that has opened the port of a board, or its transport."""
    memory = board.port == "virtual board"
    return Host(board.open() if memory else busservo.open_transport(board.port, baud=baud))


@pytest.fixture(params=WAYS)
def connect(request: pytest.FixtureRequest) -> Iterator[Callable[..., tuple[Any, Host]]]:
    """Yield a function that makes a board on real time, and a host that has opened its port."""
    with ExitStack() as boards, ExitStack() as hosts:

        def make(**options: Any) -> tuple[VirtualController, Host]:
            board = boards.enter_context(VirtualController(request.param, **options))
            host = host_at(board, options.get("baud") or LINK.baud)
            hosts.callback(host.hang_up)
            return board, host

        yield make
