"""Faults of a live line: pulled, reset, stolen, flooded, rebooted, answered with nonsense.

Over pseudo-terminals and TCP, and in virtual time where the port makes no difference. Whatever
happens, a call ends with the right value or with a declared error, in bounded time; and if the line
lives on, so does the client.
"""

import asyncio
import os
import socket
import struct
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import busservo
import pytest
import serial
from busservo import ActionGroupStopped, BatteryVoltageRead, DisconnectedError, open_controller
from busservo_simulator import Faults, VirtualController
from serial.tools import list_ports
from serial.tools.list_ports_common import ListPortInfo

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.both_clients import PORT_TALKS, Awaited, Talk, done_at_once, until
from tests.lines.conversation import again
from tests.lines.live_line import in_a_loop
from tests.lines.rfc2217_server import Rfc2217Server
from tests.timeouts import GENEROUS, LIVE, await_that

WAYS = ["tcp"] if sys.platform == "win32" else ["tcp", "pty"]
needs_pty = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
both_clients = pytest.mark.parametrize("talk", PORT_TALKS)
# Until an answer that is not to come is given up.
SHORT = 0.1
ANSWER, STOPPED, COMPLETED = (
    busservo.BatteryVoltage(7500),
    ActionGroupStopped(),
    busservo.ActionGroupCompleted(8, 1),
)


@pytest.fixture(params=WAYS)
def board(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[VirtualController]:
    """Yield a board behind a port whose name stays the same when it is plugged in again."""
    link = tmp_path / "COM7" if request.param == "pty" else None
    with VirtualController(request.param, link=link) as board:
        yield board


@contextmanager
def bounded() -> Iterator[None]:
    """Fail where it takes longer than any call may, on however slow a machine."""
    began = time.monotonic()
    yield
    assert time.monotonic() - began < GENEROUS


def reconnect(controller: busservo.Controller) -> None:
    done_at_once(again(Awaited(controller)))


def client_on_its_time(board: VirtualController) -> Any:
    return client_at(board, busservo.Controller, reply_timeout=SHORT, settle=None)


# -------------------------------------------------------------------- pulled, stolen
@both_clients
def test_pulled_in_the_middle_of_a_reply(board: VirtualController, talk: Talk) -> None:
    async def work(controller: Any) -> None:
        with bounded(), pytest.raises(DisconnectedError, match=r"was lost .*; check the cable"):
            await controller.read_battery_voltage()
        with pytest.raises(DisconnectedError):
            await controller.stop_action_group()
        with pytest.raises(busservo.TransportError):
            await controller.reconnect()
        board.faults = Faults()
        board.plug_in()
        await again(controller)
        # Half of the reply had come on the old line. It is not the beginning of the next. (The
        # voltage is not requested again before its reply has had time to come all the same.)
        assert await controller.read_servo_positions([1]) == ((1, 500),)

    board.faults = Faults(hang_up=1)
    talk(board.port, work, **LIVE)


def test_a_connection_that_is_reset_in_the_middle_of_a_reply() -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener, ThreadPoolExecutor() as pool:

        def serve() -> None:
            guest, _ = listener.accept()
            guest.recv(4)
            guest.sendall(ANSWER.encode()[:3])
            # Closed like this, it is reset, and not ended in good order.
            guest.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
            guest.close()

        pool.submit(serve)
        url = f"socket://127.0.0.1:{listener.getsockname()[1]}"
        controller = open_controller(url, **LIVE)
        with controller, bounded(), pytest.raises(DisconnectedError):
            controller.read_battery_voltage()


# -------------------------------------------------------------------- rebooted
def test_a_board_that_reboots_is_silent_and_then_back_by_itself() -> None:
    with virtual_board() as board, client_on_its_time(board) as controller:
        assert controller.request(BatteryVoltageRead()) == ANSWER
        # It is silent for longer than anybody waits here, until the test ends that.
        board.reboot(60)
        with pytest.raises(busservo.NoReplyError, match="is the device switched on"):
            controller.read_battery_voltage()
        board.reboot(0.2)
        assert controller.request(BatteryVoltageRead(), retries=3) == ANSWER
        # The port was there all the while, so there is nothing to reconnect; it does no harm.
        controller.reconnect()
        assert controller.request(BatteryVoltageRead(), retries=3) == ANSWER
        assert board.clock.now() < 2


def test_a_board_whose_port_goes_away_while_it_reboots(board: VirtualController) -> None:
    with open_controller(board.port, **LIVE) as controller:
        received: list[object] = []
        controller.on_report(received.append)
        board.report(STOPPED)
        assert next(controller.reports(timeout=GENEROUS)) == STOPPED
        board.unplug()
        with bounded(), pytest.raises(DisconnectedError):
            controller.wait_for(busservo.ActionGroupCompleted, timeout=GENEROUS)
        with pytest.raises(busservo.PortNotFoundError):
            controller.reconnect()
        board.plug_in()
        reconnect(controller)
        board.report(COMPLETED)
        assert next(controller.reports(timeout=GENEROUS)) == COMPLETED
        assert controller.read_battery_voltage() == 7500
        # Callbacks and counters live on.
        await_that(lambda: received == [STOPPED, COMPLETED])
        assert controller.counters.reports == 2


# -------------------------------------------------------------------- flooded
@contextmanager
def flooded(board: VirtualController, counters: Any) -> Iterator[list[int]]:
    """Flood the line with reports, as many as it takes; yield a list whose sum is their number."""
    said: list[int] = []
    over = threading.Event()

    def flood() -> None:
        while not over.wait(0.001):
            # However slowly the client reads: what is under way fits into the smallest port.
            if sum(said) - counters.reports < 400:
                said.append(8)
                board.send_bytes(COMPLETED.encode() * 8)

    with ThreadPoolExecutor() as pool:
        pool.submit(flood)
        try:
            yield said
        finally:
            over.set()


@both_clients
def test_a_flood_of_reports_hides_no_reply_and_is_counted(
    board: VirtualController, talk: Talk
) -> None:
    async def work(controller: Any) -> None:
        counters = controller.counters
        with flooded(board, counters) as said, bounded():
            for _ in range(10):
                assert await controller.read_battery_voltage() == 7500
                assert await controller.read_servo_positions([1]) == ((1, 500),)
            await until(controller, lambda: counters.reports >= 500)
        await until(controller, lambda: counters.reports == sum(said))
        kept = [report async for report in controller.reports(timeout=0.1)]
        assert len(kept) + counters.lost_reports == counters.reports == sum(said)
        assert counters.noise == 0

    talk(board.port, work, **LIVE, report_limit=64)


@in_turn("nonsense", lambda: [b"\x55", b"\x55\x55\xfe\x15", bytes(range(256))])
def test_a_board_that_sends_nonsense_alone_ends_in_an_error(nonsense: bytes) -> None:
    with virtual_board() as board, client_on_its_time(board) as controller:
        board.spurious_output(nonsense, per_second=500)
        for _ in range(2):
            began = board.clock.now()
            with pytest.raises(busservo.NoReplyError):
                controller.read_battery_voltage()
            # Its own time, and that of the late reply of the one before.
            assert board.clock.now() - began < 3 * SHORT + 0.2
        board.spurious_output(None)
        assert controller.request(BatteryVoltageRead(), retries=3) == ANSWER
        assert controller.counters.noise


# -------------------------------------------------------------------- closed, cancelled
def test_close_ends_what_waits_on_a_live_line(board: VirtualController) -> None:
    board.faults = Faults(dropped=1)
    controller = open_controller(board.port, **LIVE)
    with ThreadPoolExecutor(4) as pool, bounded():
        waiting: list[Future[Any]] = []
        waiting += [pool.submit(controller.read_battery_voltage) for _ in range(2)]
        listening = pool.submit(lambda: list(controller.reports()))
        waiting.append(pool.submit(controller.wait_for, ActionGroupStopped, timeout=GENEROUS))
        await_that(lambda: board.accepted)
        controller.close()
        for each in waiting:
            with pytest.raises(busservo.ClosedError):
                each.result(GENEROUS)
        assert listening.result(GENEROUS) == []


@in_a_loop
async def test_what_is_cancelled_leaves_a_live_line_usable(board: VirtualController) -> None:
    async with busservo.open_async_controller(board.port, **LIVE) as controller:
        for turn in range(20):
            asking = asyncio.ensure_future(controller.read_servo_positions([1, 2]))
            moving = asyncio.ensure_future(controller.move_servos([(1, 500)], 0))
            await asyncio.sleep(0.0005 * turn)
            asking.cancel()
            moving.cancel()
            assert await controller.read_servo_positions([3]) == ((3, 500),)
            await asyncio.gather(asking, moving, return_exceptions=True)


# -------------------------------------------------------------------- ports by other names
@needs_pty
@pytest.mark.filterwarnings("ignore:set(Daemon|Name):DeprecationWarning")
def test_a_port_over_rfc_2217(monkeypatch: pytest.MonkeyPatch) -> None:
    # pyserial sleeps between looks whether a server has agreed, and when it has closed.
    briefly = SimpleNamespace(sleep=lambda seconds: time.sleep(min(seconds, 0.001)))
    monkeypatch.setattr(serial.rfc2217, "time", briefly)
    with (
        VirtualController("pty") as board,
        Rfc2217Server(board.port) as server,
        open_controller(server.url, **LIVE) as controller,
    ):
        assert controller.read_battery_voltage() == 7500
        # 255 is an escape to that protocol.
        controller.set_action_group_speed(0xFF, percent=0x01FF)
        assert controller.read_servo_positions([1, 2]) == ((1, 500), (2, 500))
        assert set(board.board.speeds.values()) == {0x01FF}
        server.hang_up()
        with bounded(), pytest.raises(DisconnectedError):
            controller.wait_for(ActionGroupStopped, timeout=GENEROUS)
        reconnect(controller)
        assert controller.read_battery_voltage() == 7500


@needs_pty
def test_a_port_by_what_is_plugged_in(monkeypatch: pytest.MonkeyPatch) -> None:
    with VirtualController("pty") as board:
        plugged = ListPortInfo(os.path.realpath(board.port))
        plugged.description = "USB Serial CH340"
        monkeypatch.setattr(list_ports, "comports", lambda: [plugged])
        monkeypatch.setattr(list_ports, "grep", lambda words: iter([plugged] * ("CH340" in words)))
        with open_controller("hwgrep://CH340", **LIVE) as controller:
            assert controller.read_battery_voltage() == 7500
        with pytest.raises(busservo.PortNotFoundError, match=f"these exist: {plugged.device}"):
            open_controller("hwgrep://FTDI")


@needs_pty
def test_a_port_by_the_name_that_windows_would_give_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with VirtualController("pty", link="COM7"), open_controller("COM7", **LIVE) as controller:
        assert controller.read_battery_voltage() == 7500
