"""Boards on USB HID, with a device that stands in for one: no real one has been tried yet."""

import os
import sys
import types
from collections.abc import Iterator
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

import busservo
import pytest
from busservo import DisconnectedError, EncodeError, PortNotFoundError, TransportError
from busservo._library import CODEC, LINK
from framewire.codec.noise import Noise
from framewire.line.hid_devices import HidDevice, hid_devices_at_hand, hid_library
from framewire.line.hid_port import HidPort, open_hid

from tests.in_turn import in_turn
from tests.lines.both_clients import PORT_TALKS, Talk
from tests.lines.gates import closing_ends_a_read
from tests.lines.receiving import answered
from tests.timeouts import LIVE

KNOWN = {"vendor_id": 0x0483, "product_id": 0x5750, "product_string": "LOBOT"}
OTHER = {"vendor_id": 0x046D, "product_id": 0xC31C, "product_string": "Keyboard"}
BATTERY = bytes.fromhex("55 55 04 0F 4C 1D")


class Device:
    """A device as hidapi has it: reports of 64 bytes; those written begin with their number."""

    def __init__(self, padding: int = 0) -> None:
        self.written: list[bytes] = []
        self.padding = padding
        self.lost = self.closed = False
        self.takes = True
        self._reports: SimpleQueue[bytes] = SimpleQueue()
        self._blocks = True

    def open_path(self, path: bytes) -> None:
        if path.endswith(b"busy"):
            raise OSError("open failed")

    def set_nonblocking(self, on: int) -> None:
        self._blocks = not on

    def say(self, data: bytes) -> None:
        for at in range(0, len(data), 64):
            self._reports.put(data[at : at + 64].ljust(64, bytes([self.padding])))

    def read(self, size: int, timeout_ms: int = 0) -> list[int]:
        assert timeout_ms > 0 or not self._blocks, "this would wait for ever"
        if self.lost:
            raise OSError("read error")
        try:
            return [*self._reports.get(timeout=timeout_ms / 1000)[:size]]
        except Empty:
            return []

    def write(self, data: bytes) -> int:
        if self.lost:
            raise OSError("write error")
        if not self.takes:
            return -1
        self.written.append(bytes(data))
        assert (len(data), data[0]) == (65, 0)
        for event in busservo.StreamDecoder(busservo.Direction.HOST_TO_CONTROLLER).feed(data[1:]):
            for answer in [] if isinstance(event, Noise) else answered(event):
                self.say(answer.encode())
        return len(data)

    def close(self) -> None:
        self.closed = True
        if self.lost:
            raise OSError("gone")


class Library:
    """The part of the module of hidapi that is used."""

    def __init__(self, *found: dict[str, object]) -> None:
        self.enumerate = lambda: [*found]
        self.devices: list[Device] = []

    def device(self) -> Device:
        self.devices.append(Device())
        return self.devices[-1]


def plugged(**more: object) -> dict[str, object]:
    return KNOWN | {"path": b"/dev/null"} | more


@pytest.fixture
def library(monkeypatch: pytest.MonkeyPatch) -> Iterator[Library]:
    made = Library(OTHER | {"path": b"/dev/hidraw0"}, plugged())
    monkeypatch.setattr("framewire.line.hid_port.hid_library", lambda _port: made)
    yield made
    assert all(each.closed for each in made.devices)


ROOM = "the frame has {} bytes, and this line carries 64 at once: room for {}"


@pytest.mark.parametrize("talk", PORT_TALKS)
@in_turn("port", lambda: ["hid://", "HID://0483:5750", "hid:///dev/null"])
def test_a_session_by_usb_hid(library: Library, talk: Talk, port: str) -> None:
    async def work(controller: Any) -> None:
        assert await controller.read_battery_voltage() == 7500
        assert await controller.read_servo_positions([1, 2]) == ((1, 10), (2, 20))
        with pytest.raises(EncodeError) as caught:
            await controller.move_servos([(each, 500) for each in range(20)], time_ms=0)
        assert str(caught.value) == f"targets: {ROOM.format(67, '19 of 20')}"
        with pytest.raises(EncodeError) as caught:
            await controller.unload_servos(range(60))
        assert str(caught.value) == f"servo_ids: {ROOM.format(65, '59 of 60')}"
        await controller.move_servos([(each, 500) for each in range(19)], time_ms=0)
        assert await controller.read_battery_voltage() == 7500

    talk(port, work, **LIVE)
    written = library.devices[-1].written
    assert written[0] == bytes.fromhex("00 55 55 02 0F") + bytes(60)
    assert max(len(each.rstrip(b"\0")) for each in written) == 1 + 64


def port_on(device: Device) -> HidPort:
    device.set_nonblocking(1)
    return HidPort("hid://", device, 64, lambda: port_on(device), CODEC)


@in_turn(
    "padding, report, read",
    lambda: [
        (0, "55 55 04 0F 4C 1D", "55 55 04 0F 4C 1D"),
        # A position of 0 is no padding.
        (0, "55 55 06 15 01 03 00 00", "55 55 06 15 01 03 00 00"),
        # What a board left behind the frame in its buffer is padding, and no second frame.
        (0, "55 55 04 0F 4C 1D 55 55 04 0F 00 01", "55 55 04 0F 4C 1D"),
        (0xFF, "55 55 04 0F 4C 1D", "55 55 04 0F 4C 1D"),
        # Of what is no frame, nothing is dropped that may mean something.
        (0, "00 55 55 04 0F 4C 1D", "00 55 55 04 0F 4C 1D"),
        (0, "13 37 00", "13 37"),
        (0, "55 55", "55 55"),
        (0, "55 55 03 63 00", "55 55 03 63 00"),
        # A length that no frame has, and that would swallow the reports behind it.
        (0, "55 55 FF 63 01", "55 55 FF 63 01"),
        (0, "", ""),
    ],
)
def test_the_padding_of_a_report_is_dropped(padding: int, report: str, read: str) -> None:
    device = Device(padding)
    device.say(bytes.fromhex(report).ljust(64, bytes([padding])))
    port = port_on(device)
    assert port.read(0.0) == bytes.fromhex(read)
    device.say(BATTERY)
    assert port.read(0.0) == BATTERY


def test_a_reply_that_is_longer_than_a_report_comes_whole() -> None:
    device = Device()
    port = port_on(device)
    reply = busservo.ServoPositions([(each, 0) for each in range(40)]).encode()
    device.say(reply)
    device.say(BATTERY)
    assert b"".join(port.read(0.0) for _ in range(3)) == reply + BATTERY
    # Its second half never comes: the next question ends the wait for it.
    device.say(reply[:64])
    assert port.read(0.0) == reply[:64]
    port.write(busservo.BatteryVoltageRead().encode())
    assert port.read(0.0) == BATTERY


def test_more_than_a_report_holds_is_not_sent() -> None:
    device = Device()
    with pytest.raises(TransportError, match="65 bytes do not fit into a report, which has 64"):
        port_on(device).write(bytes(65))
    assert device.written == []


def test_a_board_that_is_gone_is_lost() -> None:
    device = Device()
    port = port_on(device)
    device.takes = False
    with pytest.raises(DisconnectedError, match="the report was not taken"):
        port.write(b"UU")
    device.lost = True
    with pytest.raises(DisconnectedError, match=r"the device was lost \(write error\); check the"):
        port.write(b"UU")
    with pytest.raises(DisconnectedError, match="read error"):
        port.read(0.1)
    port.drain(1)
    port.close()
    port.close()
    for use in (lambda: port.read(0.1), lambda: port.write(b"UU")):
        with pytest.raises(busservo.ClosedError):
            use()


def test_what_fails_as_it_is_closed_is_closed() -> None:
    device = Device()
    port = port_on(device)

    def write(data: bytes) -> int:
        port.close()
        raise OSError("gone")

    device.write = write  # type: ignore[method-assign]
    with pytest.raises(busservo.ClosedError):
        port.write(b"UU")


def test_closing_ends_a_read_in_another_thread() -> None:
    closing_ends_a_read(port_on(Device()))


TWO, CHOICE = ([plugged(path=b"1-1"), plugged(path=b"1-2")], r"hid://1-1 \(0483:5750\), hid://1-2 ")


@in_turn(
    "found, port, error, expected",
    lambda: [
        ([], "hid://", PortNotFoundError, r"no USB HID device is plugged in \(0483:5750\)"),
        ([OTHER | {"path": b"1"}], "hid://", PortNotFoundError, "no USB HID device"),
        ([plugged()], "hid://0483:0001", PortNotFoundError, "these exist: hid:///dev/null"),
        ([plugged()], "hid:///dev/zero", PortNotFoundError, "these exist: hid:///dev/null"),
        (
            TWO,
            "hid://0483:5750",
            busservo.PortAddressError,
            "2 devices are plugged in; choose: " + CHOICE,
        ),
        ([plugged()], "hid:", busservo.PortAddressError, "no address of USB HID; write hid://"),
        ([plugged(path=b"busy")], "hid://", TransportError, "0483:5750 cannot be opened .*udev"),
    ],
)
def test_a_board_that_cannot_be_opened_is_reported_with_advice(
    found: list[dict[str, object]], port: str, error: type[Exception], expected: str
) -> None:
    with pytest.raises(error, match=expected):
        open_hid(port, LINK, CODEC, library=Library(*found))


def test_permission_comes_with_the_rule_that_gives_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(busservo.PortPermissionError) as caught:
        open_hid("hid://", LINK, CODEC, library=Library(plugged(path=b"/dev/busy")))
    rule = 'KERNEL=="hidraw*", ATTRS{idVendor}=="0483", ATTRS{idProduct}=="5750", TAG+="uaccess"'
    assert rule in str(caught.value)


@in_turn("module", lambda: [None, types.SimpleNamespace(Device=object)])
def test_without_the_extra_it_says_how_to_get_it(
    monkeypatch: pytest.MonkeyPatch, module: object
) -> None:
    """Another package is imported by the same name, and is no help either."""
    for name in ("hid", "hidraw"):
        monkeypatch.setitem(sys.modules, name, module)
    problem = (
        "hid://: USB HID needs the package hidapi, which is not installed "
        r"\(not seen on hardware yet\); pip install hidapi"
    )
    with pytest.raises(TransportError, match=problem):
        busservo.open_controller("hid://")


def test_the_module_that_leaves_the_device_to_the_kernel_is_preferred(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    first, second = Library(), Library()
    monkeypatch.setitem(sys.modules, "hidraw", first)
    monkeypatch.setitem(sys.modules, "hid", second)
    monkeypatch.setattr("sys.platform", "linux")
    assert hid_library("hid://") is first
    monkeypatch.setattr("sys.platform", "darwin")
    assert hid_library("hid://") is second


def test_linux_lists_boards_without_the_extra(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("hid", "hidraw"):
        monkeypatch.setitem(sys.modules, name, None)
    assert hid_devices_at_hand(LINK, tmp_path / "none") is None
    assert hid_devices_at_hand(LINK, tmp_path) == []
    board = tmp_path / "0003:0483:5750.0001"
    (board / "hidraw" / "hidraw3").mkdir(parents=True)
    (board / "uevent").write_text("HID_ID=0003\nHID_NAME=LOBOT\nHID_UNIQ=48D7\n")
    # A keyboard, the same ids by Bluetooth, and what is no device.
    for other in ("0003:046D:C31C.0002", "0005:0483:5750.0003", "driver", "a:b:c.1"):
        (tmp_path / other).mkdir()
    assert hid_devices_at_hand(LINK, tmp_path) == [
        HidDevice(0x0483, 0x5750, "/dev/hidraw3", "LOBOT")
    ]
    (tmp_path / "0003:0483:5750.0009").mkdir()
    assert hid_devices_at_hand(LINK, tmp_path)[0] == HidDevice(0x0483, 0x5750, "", "")  # type: ignore[index]
