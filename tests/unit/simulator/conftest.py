"""Boards for tests, by each kind of port."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import pytest
from busservo import open_transport
from busservo._library import LINK
from busservo_simulator import VirtualController

from tests.lines.at_board import virtual_board
from tests.lines.boards import no_board_refuses_anything, pytest_runtest_makereport
from tests.lines.hosts import Host, host_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["no_board_refuses_anything", "pytest_runtest_makereport"]

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


@pytest.fixture(params=WAYS)
def connect(request: pytest.FixtureRequest) -> Iterator[Callable[..., tuple[Any, Host]]]:
    """Yield a function that makes a board on real time, and a host that has opened its port."""
    boards: list[VirtualController] = []
    hosts: list[Host] = []

    def make(**options: Any) -> tuple[VirtualController, Host]:
        board = VirtualController(request.param, **options)
        board.start()
        boards.append(board)
        memory = request.param == "memory"
        baud = options.get("baud") or LINK.baud
        hosts.append(Host(board.transport if memory else open_transport(board.port, baud=baud)))
        return board, hosts[-1]

    yield make
    for host in hosts:
        host.hang_up()
    for board in boards:
        board.close()
