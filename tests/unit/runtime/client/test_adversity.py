"""Faults of a live line: pulled, reset, stolen, flooded, rebooted, answered with nonsense.

Over pseudo-terminals and TCP, and in virtual time where the port makes no difference. Whatever
happens, a call ends with the right value or with a declared error, in bounded time; and if the line
lives on, so does the client.
"""

from __future__ import annotations

import asyncio
import os
import socket
import struct
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest
import serial
from busservo import (
    ActionGroupCompleted,
    ActionGroupStopped,
    AsyncController,
    BatteryVoltage,
    BatteryVoltageRead,
    ClosedError,
    Controller,
    DisconnectedError,
    NoReplyError,
    PortBusyError,
    PortNotFoundError,
    ServoPosition,
    TransportError,
    open_async_controller,
    open_controller,
    open_transport,
)
from busservo_simulator import Faults, VirtualController
from busservo_simulator.virtual_loop import run_virtual
from serial.tools import list_ports
from serial.tools.list_ports_common import ListPortInfo

from tests.in_turn import in_turn
from tests.lines.at_board import client_at, virtual_board
from tests.lines.rfc2217_server import Rfc2217Server
from tests.timeouts import GENEROUS, LIVE, await_that

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

WAYS = ["tcp"] if sys.platform == "win32" else ["tcp", "pty"]
needs_pty = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
# No call may take longer, on however slow a machine. An answer that is to come may take as long.
BOUND = GENEROUS
# Until an answer that is not to come is given up.
SHORT = 0.1


@pytest.fixture(params=WAYS)
def board(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[VirtualController]:
    """Yield a board behind a port whose name stays the same when it is plugged in again."""
    link = tmp_path / "COM7" if request.param == "pty" else None
    with VirtualController(request.param, link=link) as board:
        yield board


@contextmanager
def bounded(seconds: float = BOUND) -> Iterator[None]:
    began = time.monotonic()
    yield
    assert time.monotonic() - began < seconds


def client_on_its_time(board: VirtualController) -> Any:
    return client_at(board, Controller, reply_timeout=SHORT, settle=None)


def again(controller: Controller) -> None:
    """Reconnect, as often as it takes."""
    end = time.monotonic() + BOUND
    while True:
        try:
            controller.reconnect()
        except TransportError:
            assert time.monotonic() < end
            time.sleep(0.01)
        else:
            return


# -------------------------------------------------------------------- pulled


def test_pulled_in_the_middle_of_a_reply(board: VirtualController) -> None:
    board.faults = Faults(hang_up=1)
    with open_controller(board.port, **LIVE) as controller:
        with bounded(), pytest.raises(DisconnectedError, match=r"was lost .*; check the cable"):
            controller.read_battery_voltage()
        with pytest.raises(DisconnectedError):
            controller.stop_action_group()
        with pytest.raises(TransportError):
            controller.reconnect()
        board.faults = Faults()
        board.plug_in()
        again(controller)
        # Half of the reply had come on the old line. It is not the beginning of the next. (The
        # voltage is not requested again before its reply has had time to come all the same.)
        assert controller.read_servo_positions([1]) == (ServoPosition(1, 500),)


def test_pulled_in_the_middle_of_a_reply_with_asyncio(board: VirtualController) -> None:
    board.faults = Faults(hang_up=1)

    async def work() -> None:
        async with open_async_controller(board.port, **LIVE) as controller:
            asking = [asyncio.ensure_future(controller.read_battery_voltage()) for _ in range(5)]
            with bounded():
                for each in asking:
                    with pytest.raises(DisconnectedError):
                        await each
            board.faults = Faults()
            board.plug_in()
            end = time.monotonic() + BOUND
            while time.monotonic() < end:
                try:
                    await controller.reconnect()
                    break
                except TransportError:
                    await asyncio.sleep(0.01)
            assert await controller.read_servo_positions([1]) == (ServoPosition(1, 500),)

    asyncio.run(work())


def test_a_connection_that_is_reset_in_the_middle_of_a_reply() -> None:
    listener = socket.create_server(("127.0.0.1", 0))

    def serve() -> None:
        guest, _ = listener.accept()
        guest.recv(4)
        guest.sendall(BatteryVoltage(7500).encode()[:3])
        # Closed like this, it is reset, and not ended in good order.
        guest.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        guest.close()

    thread = threading.Thread(target=serve)
    thread.start()
    url = f"socket://127.0.0.1:{listener.getsockname()[1]}"
    with (
        open_controller(url, **LIVE) as controller,
        bounded(),
        pytest.raises(DisconnectedError),
    ):
        controller.read_battery_voltage()
    thread.join()
    listener.close()


# -------------------------------------------------------------------- stolen


@needs_pty
def test_a_port_that_somebody_else_has_is_busy() -> None:
    with (
        VirtualController("pty") as board,
        serial.Serial(board.port, exclusive=True),
        pytest.raises(PortBusyError, match=f"{board.port}: it is in use; close the other"),
    ):
        open_controller(board.port)


@needs_pty
def test_another_reader_of_the_port_costs_replies_and_makes_none_wrong() -> None:
    with VirtualController("pty") as board:
        stolen = 0
        begun, over = threading.Event(), threading.Event()

        def steal() -> None:
            nonlocal stolen
            with serial.Serial(board.port, 9600, timeout=0.01) as thief:
                begun.set()
                while not over.is_set():
                    try:
                        stolen += len(thief.read(3))
                    except serial.SerialException:
                        # Ready, and empty when read: the other has been quicker.
                        continue

        thread = threading.Thread(target=steal)
        thread.start()
        results = set()
        try:
            assert begun.wait(BOUND)
            with open_controller(board.port, exclusive=False, reply_timeout=0.02) as controller:
                requests, end = 0, time.monotonic() + BOUND
                while requests < 20 or (not stolen and time.monotonic() < end):
                    requests += 1
                    with bounded():
                        try:
                            results.add(controller.read_battery_voltage())
                        except (NoReplyError, TransportError) as error:
                            if isinstance(error, TransportError):
                                again(controller)
        finally:
            over.set()
            thread.join()
        assert stolen
        assert results <= {7500}


# -------------------------------------------------------------------- rebooted


def test_a_board_that_reboots_is_silent_and_then_back_by_itself() -> None:
    answer = BatteryVoltage(7500)
    with virtual_board() as board, client_on_its_time(board) as controller:
        assert controller.request(BatteryVoltageRead()) == answer
        # It is silent for longer than anybody waits here, until the test ends that.
        board.reboot(60)
        with pytest.raises(NoReplyError, match="is the device switched on"):
            controller.read_battery_voltage()
        board.reboot(0.2)
        assert controller.request(BatteryVoltageRead(), retries=3) == answer
        # The port was there all the while, so there is nothing to reconnect; it does no harm.
        controller.reconnect()
        assert controller.request(BatteryVoltageRead(), retries=3) == answer
        assert board.clock.now() < 2


def test_a_board_whose_port_goes_away_while_it_reboots(board: VirtualController) -> None:
    with open_controller(board.port, **LIVE) as controller:
        received: list[object] = []
        controller.on_report(received.append)
        board.report(ActionGroupStopped())
        assert next(controller.reports(timeout=BOUND)) == ActionGroupStopped()
        board.unplug()
        with bounded(), pytest.raises(DisconnectedError):
            controller.wait_for(ActionGroupCompleted, timeout=BOUND)
        with pytest.raises(PortNotFoundError):
            controller.reconnect()
        board.plug_in()
        again(controller)
        board.report(ActionGroupCompleted(8, 1))
        assert next(controller.reports(timeout=BOUND)) == ActionGroupCompleted(8, 1)
        assert controller.read_battery_voltage() == 7500
        # Callbacks and counters live on.
        await_that(lambda: received == [ActionGroupStopped(), ActionGroupCompleted(8, 1)])
        assert controller.counters.reports == 2


# -------------------------------------------------------------------- flooded


@contextmanager
def flooded(
    board: VirtualController, controller: Controller | AsyncController
) -> Iterator[list[int]]:
    """Flood the line with reports, as many as it takes; yield a list whose sum is their number."""
    said: list[int] = []
    over = threading.Event()

    def flood() -> None:
        while not over.wait(0.001):
            # However slowly the client reads: what is under way fits into the smallest port.
            if sum(said) - controller.counters.reports < 400:
                said.append(8)
                board.send_bytes(ActionGroupCompleted(8, 1).encode() * 8)

    thread = threading.Thread(target=flood)
    thread.start()
    try:
        yield said
    finally:
        over.set()
        thread.join()


def test_a_flood_of_reports_hides_no_reply_and_is_counted(board: VirtualController) -> None:
    with open_controller(board.port, **LIVE, report_limit=64) as controller:
        counters = controller.counters
        with flooded(board, controller) as said:
            with bounded():
                for _ in range(10):
                    assert controller.read_battery_voltage() == 7500
                    assert controller.read_servo_positions([1]) == (ServoPosition(1, 500),)
            await_that(lambda: counters.reports >= 500)
        await_that(lambda: counters.reports == sum(said))
        kept = sum(1 for _ in controller.reports(timeout=0.1))
        assert kept + counters.lost_reports == counters.reports == sum(said)
        assert counters.noise == 0


def test_a_flood_of_reports_hides_no_reply_with_asyncio(board: VirtualController) -> None:
    async def work() -> None:
        async with open_async_controller(board.port, **LIVE, report_limit=64) as controller:
            counters = controller.counters
            with flooded(board, controller) as said, bounded():
                for _ in range(10):
                    assert await controller.read_battery_voltage() == 7500
                while not said:
                    await asyncio.sleep(0.001)
            while counters.reports < sum(said):
                await asyncio.sleep(0.001)
            kept = [report async for report in controller.reports(timeout=0.1)]
            assert len(kept) + counters.lost_reports == counters.reports == sum(said)

    asyncio.run(work())


@in_turn("nonsense", lambda: [b"\x55", b"\x55\x55\xfe\x15", bytes(range(256))])
def test_a_board_that_sends_nonsense_alone_ends_in_an_error(nonsense: bytes) -> None:
    with virtual_board() as board, client_on_its_time(board) as controller:
        board.spurious_output(nonsense, per_second=500)
        for _ in range(2):
            began = board.clock.now()
            with pytest.raises(NoReplyError):
                controller.read_battery_voltage()
            # Its own time, and that of the late reply of the one before.
            assert board.clock.now() - began < 3 * SHORT + 0.2
        board.spurious_output(None)
        assert controller.request(BatteryVoltageRead(), retries=3) == BatteryVoltage(7500)
        assert controller.counters.noise


def test_a_board_that_sends_nonsense_alone_ends_in_an_error_with_asyncio() -> None:
    async def work(board: VirtualController) -> None:
        async with client_at(
            board, AsyncController, reply_timeout=SHORT, settle=None
        ) as controller:
            board.spurious_output(b"\x55", per_second=500)
            with pytest.raises(NoReplyError):
                await controller.read_battery_voltage()
            assert board.clock.now() < 3 * SHORT + 0.2
            board.spurious_output(None)
            answer = await controller.request(BatteryVoltageRead(), retries=3)
            assert answer == BatteryVoltage(7500)

    with virtual_board() as board:
        run_virtual(work(board), board.clock)  # type: ignore[arg-type]


# -------------------------------------------------------------------- closed, cancelled


def test_close_ends_what_waits_on_a_live_line(board: VirtualController) -> None:
    board.faults = Faults(dropped=1)
    controller = open_controller(board.port, **LIVE)
    with ThreadPoolExecutor(4) as pool, bounded():
        asking = [pool.submit(controller.read_battery_voltage) for _ in range(2)]
        listening = pool.submit(lambda: list(controller.reports()))
        pending = pool.submit(controller.wait_for, ActionGroupStopped, timeout=BOUND)
        while not board.accepted:
            time.sleep(0.002)
        controller.close()
        for each in asking:
            with pytest.raises(ClosedError):
                each.result(BOUND)
        with pytest.raises(ClosedError):
            pending.result(BOUND)
        assert listening.result(BOUND) == []


def test_what_is_cancelled_leaves_a_live_line_usable(board: VirtualController) -> None:
    async def work() -> None:
        async with open_async_controller(board.port, **LIVE) as controller:
            for turn in range(20):
                asking = asyncio.ensure_future(controller.read_servo_positions([1, 2]))
                moving = asyncio.ensure_future(controller.move_servos([(1, 500)], 0))
                await asyncio.sleep(0.0005 * turn)
                asking.cancel()
                moving.cancel()
                found = await controller.read_servo_positions([3])
                assert found == (ServoPosition(3, 500),)
                await asyncio.gather(asking, moving, return_exceptions=True)

    asyncio.run(work())


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
            controller.wait_for(ActionGroupStopped, timeout=BOUND)
        again(controller)
        assert controller.read_battery_voltage() == 7500


@needs_pty
def test_a_port_by_what_is_plugged_in(
    board: VirtualController, monkeypatch: pytest.MonkeyPatch
) -> None:
    if board.port.startswith("socket:"):
        pytest.skip("no port of this machine")
    plugged = ListPortInfo(os.path.realpath(board.port))
    plugged.description = "USB Serial CH340"
    monkeypatch.setattr(list_ports, "comports", lambda: [plugged])
    monkeypatch.setattr(list_ports, "grep", lambda regexp: iter([plugged] * ("CH340" in regexp)))
    with open_controller("hwgrep://CH340", **LIVE) as controller:
        assert controller.read_battery_voltage() == 7500
    with pytest.raises(PortNotFoundError, match=f"these exist: {plugged.device}"):
        open_controller("hwgrep://FTDI")


@needs_pty
def test_a_port_by_the_name_that_windows_would_give_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with VirtualController("pty", link="COM7"), open_controller("COM7", **LIVE) as controller:
        assert controller.read_battery_voltage() == 7500


@in_turn("port", lambda: ["rfc2217://127.0.0.1:1", "rfc2217://nowhere", "cp2110://"])
def test_a_url_that_leads_nowhere_is_an_error_that_says_so(port: str) -> None:
    with bounded(), pytest.raises(TransportError, match=port):
        open_transport(port)
