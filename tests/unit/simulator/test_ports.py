"""The board behind a pty, behind TCP and in the same process: the same board every time."""

from __future__ import annotations

import select
import socket
import struct
import sys
import time
from typing import TYPE_CHECKING, Any

import pytest
from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    ServoMove,
    ServoPositions,
    ServoPositionsRead,
    ServoUnload,
    open_transport,
)
from busservo_simulator import VirtualClock, VirtualController
from framewire.line.link_errors import TransportError
from framewire.simulator.tcp_end import TcpEnd
from framewire.simulator.waker import Waker

from tests.in_turn import in_turn
from tests.lines.hosts import Host
from tests.timeouts import GENEROUS, await_that

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    Connect = Callable[..., tuple[Any, Host]]

VOLTAGE = BatteryVoltage(7500)
ASK = BatteryVoltageRead()
STOPPED = ActionGroupStopped()
needs_pty = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")


def test_every_request_is_met_as_it_should_be(connect: Connect) -> None:
    board, host = connect()
    assert host.ask(ASK) == VOLTAGE
    host.say(ServoMove(0, [(1, 510)]), ServoUnload([2]))
    assert isinstance(host.ask(ServoPositionsRead([1, 2])), ServoPositions)
    assert not board.servos[2].loaded
    assert host.ask(ActionGroupRun(2, 0)) == ActionGroupStarted(2, 0)
    assert host.ask(ActionGroupStop()) == ActionGroupStopped()
    assert (board.accepted, board.rejects.total) == (6, 0)


def test_writes_may_be_cut_anywhere(connect: Connect) -> None:
    board, host = connect()
    request = ServoPositionsRead(range(1, 7)).encode()
    for cut in range(1, len(request)):
        host.transport.write(request[:cut])
        host.transport.write(request[cut:])
        assert isinstance(host.receive(), ServoPositions)
    assert board.rejects.total == 0


@pytest.mark.parametrize("extra", ["00", "55", "FF 55", "55 55 FF"])
@pytest.mark.garbage
def test_a_stray_byte_costs_no_frame(connect: Connect, extra: str) -> None:
    board, host = connect()
    host.transport.write(bytes.fromhex(extra))
    host.say(ASK, ASK)
    assert host.receive() == VOLTAGE
    assert host.receive() == VOLTAGE
    assert board.rejects.total >= 1


def test_replies_are_exact(connect: Connect) -> None:
    _, host = connect()
    host.say(ASK, ServoPositionsRead([3]))
    assert host.collect(14).hex(" ").upper() == "55 55 04 0F 4C 1D 55 55 06 15 01 03 F4 01"


def test_reports_come_in_the_order_of_what_happened(connect: Connect) -> None:
    clock = VirtualClock()
    board, host = connect(clock=clock)
    assert host.ask(ActionGroupRun(1, 1)) == ActionGroupStarted(1, 1)
    board.advance(10)
    assert host.ask(ASK) == ActionGroupCompleted(1, 1)
    assert host.receive() == VOLTAGE


def test_the_clock_can_be_moved_by_hand_on_any_port(connect: Connect) -> None:
    board, host = connect(clock=VirtualClock())
    host.say(ServoMove(1000, [(1, 900)]))
    assert host.ask(ASK) == BatteryVoltage(7475)  # one servo sets off
    board.advance(0.5)
    assert host.ask(ServoPositionsRead([1])) == ServoPositions([(1, 700)])


def test_no_byte_comes_before_the_wire_could_carry_it(connect: Connect) -> None:
    _, host = connect(baud=9600)
    begun = time.monotonic()
    for _ in range(5):
        assert isinstance(host.ask(ServoPositionsRead(range(1, 7))), ServoPositions)
    assert time.monotonic() - begun >= 5 * 34 / 960


def test_a_fast_writer_is_slowed_to_the_line(connect: Connect) -> None:
    board, host = connect(baud=921600)
    move = ServoMove(0, [(1, 500)])
    for _ in range(500):
        host.say(move)
    assert host.ask(ASK) == VOLTAGE
    assert (board.accepted, board.rejects.total) == (501, 0)


def test_a_cable_can_be_pulled_and_put_back(connect: Connect) -> None:
    board, host = connect()
    assert host.ask(ASK) == VOLTAGE
    board.unplug()
    with pytest.raises(TransportError):
        host.receive()
    board.plug_in()
    again = Host(board.open() if board.port == "virtual board" else open_transport(board.port))
    assert again.ask(ASK) == VOLTAGE
    again.hang_up()


def test_closing_a_board_twice_is_no_error(connect: Connect) -> None:
    board, _ = connect()
    board.unplug()
    board.unplug()
    board.close()
    board.close()


def test_a_port_can_be_opened_again(connect: Connect) -> None:
    board, host = connect()
    if board.port == "virtual board":
        pytest.skip("there is nothing to open")
    for _ in range(3):
        host.hang_up()
        host = Host(open_transport(board.port))
        assert host.ask(ASK) == VOLTAGE
    host.hang_up()


@needs_pty
def test_a_link_is_a_name_that_stays(tmp_path: Path) -> None:
    link = tmp_path / "COM7"
    with VirtualController("pty", link=link) as board:
        assert board.port == str(link)
        for _ in range(2):
            host = Host(open_transport(str(link)))
            assert host.ask(ASK) == VOLTAGE
            board.unplug()
            assert not link.is_symlink()
            board.plug_in()
            host.hang_up()
        assert link.is_symlink()
    assert not link.is_symlink()


@needs_pty
def test_a_link_replaces_no_file(tmp_path: Path) -> None:
    link = tmp_path / "COM7"
    link.write_text("mine")
    with pytest.raises(FileExistsError):
        VirtualController("pty", link=link).start()
    assert link.read_text() == "mine"


@needs_pty
def test_a_link_replaces_one_that_was_left_behind(tmp_path: Path) -> None:
    link = tmp_path / "COM7"
    link.symlink_to("/dev/nothing")
    with VirtualController("pty", link=link) as board:
        host = Host(open_transport(board.port))
        assert host.ask(ASK) == VOLTAGE
        host.hang_up()


def test_tcp_listens_on_loopback_alone() -> None:
    with VirtualController("tcp") as board:
        assert board.port.startswith("socket://127.0.0.1:")


def test_tcp_serves_one_host_at_a_time_and_then_the_next() -> None:
    with VirtualController("tcp") as board:
        address = ("127.0.0.1", int(board.port.rpartition(":")[2]))
        with socket.create_connection(address, timeout=GENEROUS) as first:
            first.sendall(ASK.encode())
            assert first.recv(100) == VOLTAGE.encode()
            with socket.create_connection(address, timeout=GENEROUS) as second:
                assert second.recv(100) == b""
        with socket.create_connection(address, timeout=GENEROUS) as third:
            third.sendall(ASK.encode())
            assert third.recv(100) == VOLTAGE.encode()


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
def test_over_tcp_a_host_that_comes_as_another_leaves_is_let_in(size: int) -> None:
    end = TcpEnd()
    end.plug_in()
    address = ("127.0.0.1", int(end.port.rpartition(":")[2]))
    first = socket.create_connection(address, GENEROUS)
    others: list[socket.socket] = []

    def leave() -> None:
        if not others:
            first.sendall(bytes(size))
            first.close()
            others.append(socket.create_connection(address, GENEROUS))
            others[0].sendall(b"second")

    assert end.receive() == b""
    end._guest = Hasty(end._guest, leave)  # type: ignore[assignment, arg-type]
    received = bytearray()

    def all_is_there() -> bool:
        received.extend(end.receive())
        return received.endswith(b"second")

    await_that(all_is_there)
    assert received == bytes(size) + b"second"
    end.close()
    others[0].close()


def test_over_tcp_a_connected_host_receives_all_that_is_sent() -> None:
    with VirtualController("tcp") as board:
        for _ in range(20):
            host = Host(open_transport(board.port))
            board.report(ActionGroupStopped())
            assert host.receive() == ActionGroupStopped()
            host.hang_up()
            await_that(lambda: board._end._guest is None)  # type: ignore[attr-defined]


def test_tcp_comes_back_on_the_same_number() -> None:
    with VirtualController("tcp") as board:
        port = board.port
        board.unplug()
        board.plug_in()
        assert board.port == port


def test_a_number_in_use_is_an_error() -> None:
    with VirtualController("tcp") as board:
        number = int(board.port.rpartition(":")[2])
        with pytest.raises(OSError, match=r"in use|normally permitted|denied"):
            VirtualController("tcp", tcp_port=number).start()


def test_a_host_that_reads_nothing_stops_nobody() -> None:
    with VirtualController("tcp") as board:
        host = Host(open_transport(board.port))
        for _ in range(200):
            board.send_bytes(bytes(50_000))
        host.hang_up()
        assert board.battery.voltage_mv == 7500


def test_a_host_that_crashes_makes_room_for_the_next() -> None:
    with VirtualController("tcp") as board:
        address = ("127.0.0.1", int(board.port.rpartition(":")[2]))
        host = socket.create_connection(address, timeout=GENEROUS)
        host.sendall(ASK.encode())
        assert host.recv(100) == VOLTAGE.encode()
        crash(host)
        again = Host(open_transport(board.port))
        assert again.ask(ASK) == VOLTAGE
        again.hang_up()


def test_bytes_sent_to_a_crashed_host_are_lost() -> None:
    end = TcpEnd()
    end.plug_in()
    try:
        address = ("127.0.0.1", int(end.port.rpartition(":")[2]))
        host = socket.create_connection(address, timeout=GENEROUS)
        end.wait(GENEROUS, listening=True)
        assert end.receive() == b""
        crash(host)
        end.wait(GENEROUS, listening=True)
        end.deliver(VOLTAGE.encode())
        with socket.create_connection(address, timeout=GENEROUS) as again:
            end.wait(GENEROUS, listening=True)
            end.deliver(STOPPED.encode())
            assert again.recv(100) == STOPPED.encode()
    finally:
        end.close()


def crash(host: socket.socket) -> None:
    """End a connection as a computer does that is switched off: nothing is finished."""
    host.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    host.close()


def test_an_unplugged_board_sends_nothing(connect: Connect) -> None:
    board, _ = connect()
    board.unplug()
    board.send_bytes(STOPPED.encode())
    board.plug_in()
    host = Host(board.open() if board.port == "virtual board" else open_transport(board.port))
    assert host.ask(ASK) == VOLTAGE
    assert host.received == []
    host.hang_up()


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
