"""The board in the same process: reads and writes without a port, in threads as well."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import pytest
from busservo import ServoMove
from busservo_simulator import VirtualController
from framewire.line.link_errors import ClosedError, DisconnectedError, PortNotFoundError

from tests.lines.at_board import virtual_board
from tests.lines.hosts import Host
from tests.timeouts import GENEROUS
from tests.unit.runtime.simulator.conftest import ASK, VOLTAGE

if TYPE_CHECKING:
    from collections.abc import Callable


def test_drain_waits_for_what_is_on_the_wire_and_no_longer_than_told() -> None:
    with virtual_board(baud=9600) as board:
        for _ in range(10):
            board.transport.write(ServoMove(100, [(1, 600)]).encode())
        assert board.accepted == 0
        for timeout, moment in ((0.05, 0.05), (10, 100 / 960)):
            board.transport.drain(timeout)
            assert board.clock.now() == pytest.approx(moment)
        assert board.accepted == 10


def reading(read: Callable[[], object]) -> tuple[threading.Thread, list[object]]:
    """Return a thread that reads, and the list for what it reads, or for how that fails."""
    found: list[object] = []

    def run() -> None:
        try:
            found.append(read())
        except ClosedError as error:
            found.append(type(error))

    thread = threading.Thread(target=run)
    thread.start()
    return thread, found


def test_closing_ends_a_read_in_another_thread() -> None:
    with VirtualController() as board:
        reader, found = reading(lambda: board.transport.read(2 * GENEROUS))
        board.transport.close()
        reader.join(GENEROUS)
        assert found == [ClosedError]
        with pytest.raises(ClosedError):
            board.transport.write(b"")
        board.open().write(ASK.encode())
        assert Host(board.transport).receive() == VOLTAGE


def test_an_unplugged_board_is_an_error_until_it_is_plugged_in(
    board: VirtualController, host: Host
) -> None:
    host.say(ASK)
    board.unplug()
    assert board.transport.read(0) == VOLTAGE.encode()
    calls: list[tuple[Callable[[], object], type[Exception]]] = [
        (lambda: board.transport.read(1), DisconnectedError),
        (lambda: host.say(ASK), DisconnectedError),
        (board.open, PortNotFoundError),
    ]
    for call, error in calls:
        with pytest.raises(error):
            call()
    board.plug_in()
    board.open()
    assert host.ask(ASK) == VOLTAGE
