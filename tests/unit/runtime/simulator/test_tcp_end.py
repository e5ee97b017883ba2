"""The board behind TCP: one host at a time, whoever comes, leaves, crashes or reads nothing."""

from __future__ import annotations

import select
import socket
import struct
from contextlib import closing
from typing import TYPE_CHECKING, Any

import pytest
from busservo_simulator import VirtualController
from framewire.simulator.tcp_end import TcpEnd
from framewire.simulator.waker import Waker

from tests.in_turn import in_turn
from tests.timeouts import GENEROUS, await_that
from tests.unit.runtime.simulator.conftest import ASK, STOPPED, VOLTAGE, host_at

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@pytest.fixture
def board() -> Iterator[VirtualController]:
    with VirtualController("tcp") as board:
        yield board


def connected(end: VirtualController | TcpEnd) -> socket.socket:
    """Return a connection to the port of an end."""
    host, _, number = end.port.removeprefix("socket://").rpartition(":")
    return socket.create_connection((host, int(number)), GENEROUS)


def assert_served(host: socket.socket) -> None:
    host.sendall(ASK.encode())
    assert host.recv(100) == VOLTAGE.encode()


def crash(host: socket.socket) -> None:
    """End a connection as a computer does that is switched off: nothing is finished."""
    host.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    host.close()


def test_it_serves_one_host_at_a_time_and_then_the_next(board: VirtualController) -> None:
    with connected(board) as first:
        assert_served(first)
        with connected(board) as second:
            assert second.recv(100) == b""
    with connected(board) as third:
        assert_served(third)


class Hasty:
    """The connection of a host that leaves as soon as it has been read, for another to come."""

    def __init__(self, guest: socket.socket, leave: Callable[[], object]) -> None:
        self._guest = guest
        self._leave = leave

    def recv(self, most: int) -> bytes:
        try:
            return self._guest.recv(most)
        except BlockingIOError:
            self._leave()
            raise

    def __getattr__(self, name: str) -> Any:
        return getattr(self._guest, name)


@in_turn("size", lambda: [0, 3, 20_000])
def test_a_host_that_comes_as_another_leaves_is_let_in(size: int) -> None:
    with closing(TcpEnd()) as end:
        end.plug_in()
        first = connected(end)
        others: list[socket.socket] = []

        def leave() -> None:
            if not others:
                first.sendall(bytes(size))
                first.close()
                others.append(connected(end))
                others[0].sendall(b"second")

        assert end.receive() == b""
        end._guest = Hasty(end._guest, leave)  # type: ignore[assignment, arg-type]
        received = bytearray()

        def all_is_there() -> bool:
            received.extend(end.receive())
            return received.endswith(b"second")

        await_that(all_is_there)
        assert received == bytes(size) + b"second"
    others[0].close()


def test_a_host_that_reads_nothing_stops_nobody(board: VirtualController) -> None:
    host = host_at(board)
    for _ in range(200):
        board.send_bytes(bytes(50_000))
    host.hang_up()
    assert board.battery.voltage_mv == 7500


def test_a_host_that_crashes_makes_room_for_the_next(board: VirtualController) -> None:
    host = connected(board)
    assert_served(host)
    crash(host)
    again = host_at(board)
    assert again.ask(ASK) == VOLTAGE
    again.hang_up()


def test_bytes_sent_to_a_crashed_host_are_lost() -> None:
    with closing(TcpEnd()) as end:
        end.plug_in()
        host = connected(end)
        end.wait(GENEROUS, listening=True)
        assert end.receive() == b""
        crash(host)
        end.wait(GENEROUS, listening=True)
        end.deliver(VOLTAGE.encode())
        with connected(end) as again:
            end.wait(GENEROUS, listening=True)
            end.deliver(STOPPED.encode())
            assert again.recv(100) == STOPPED.encode()


# -------------------------------------------------------------------- what wakes its thread
def test_a_closed_waker_wakes_nobody() -> None:
    waker = Waker()
    waker.wake()
    waker.clear()
    assert waker.fileno() == -1
    waker.open()
    waker.wake()
    assert select.select([waker], [], [], GENEROUS)[0] == [waker]
    waker.clear()
    assert select.select([waker], [], [], 0)[0] == []
    waker.close()
    assert waker.fileno() == -1
