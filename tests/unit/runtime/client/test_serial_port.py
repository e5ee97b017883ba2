"""Real ports: pseudo-terminals and sockets through pyserial, and their failures."""

import contextlib
import os
import socket
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

import busservo
import pytest
import serial
from busservo import PortAddressError, PortNotFoundError, open_controller, open_transport
from busservo._library import CODEC, LINK
from busservo_simulator import VirtualController
from framewire.line.hid_port import HidPort
from framewire.line.port_errors import not_opened
from framewire.line.serial_port import SerialPort

from tests.in_turn import in_turn
from tests.lines.both_clients import PORT_TALKS, Talk
from tests.lines.gates import Gate, whoever_closes_second_waits
from tests.lines.live_line import in_a_loop
from tests.timeouts import GENEROUS, LIVE

pytest.importorskip("pty", reason="there are pseudo-terminals only where there is a tty")


@pytest.fixture
def board(tmp_path: Path) -> Iterator[VirtualController]:
    """Yield a board behind a pseudo-terminal; its name is a link, which leads nowhere once closed.

    The system soon gives the name of a pseudo-terminal that is closed to another one.
    """
    with VirtualController("pty", link=tmp_path / "port") as made:
        yield made


@pytest.fixture
def tcp() -> Iterator[VirtualController]:
    with VirtualController("tcp") as made:
        yield made


def test_what_a_socket_holds_is_read_at_once_and_not_byte_by_byte(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    sent = bytes(range(256)) * 8
    with socket.create_server(("127.0.0.1", 0)) as listener:
        transport = open_transport(f"socket://127.0.0.1:{listener.getsockname()[1]}")
        assert isinstance(transport, SerialPort)
        pieces: list[bytes] = []
        read = transport._port.read

        def noted(size: int) -> bytes:
            pieces.append(read(size))
            return pieces[-1]

        monkeypatch.setattr(transport._port, "read", noted)
        other_end, _ = listener.accept()
        with other_end:
            other_end.sendall(sent)
            while sum(map(len, pieces)) < len(sent):
                transport.read(5)
            transport.close()
    assert b"".join(pieces) == sent
    assert len(pieces) < 10


def test_a_socket_sends_small_frames_at_once(tcp: VirtualController) -> None:
    transport = open_transport(tcp.port)
    assert isinstance(transport, SerialPort)
    assert transport._port._socket.getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
    transport.close()


@in_a_loop
async def test_a_client_for_asyncio_is_opened_by_awaiting_it(board: VirtualController) -> None:
    awaited = await busservo.open_async_controller(board.port, **LIVE)
    assert await awaited.read_servo_positions([3]) == ((3, 500),)
    await awaited.close()
    with pytest.raises(PortNotFoundError):
        async with busservo.open_async_controller(f"{board.port}0000"):
            pass


def test_a_port_is_exclusive_by_default(board: VirtualController) -> None:
    with open_controller(board.port, **LIVE) as first:
        with pytest.raises(busservo.PortBusyError, match="it is in use; close the other program"):
            open_controller(board.port)
        assert first.read_battery_voltage() == 7500
    with open_controller(board.port, exclusive=False) as one:
        with open_controller(board.port, exclusive=False):
            pass
        assert not one.closed


REFUSED_NAMES = {
    "": "^'': this is no name; name a port",
    " ": "^' ': this is no name; name a port",
    "hwgrep://CH340(": r"'CH340\(' is no regular expression .*, such as hwgrep://CH340$",
    "hwgrep://": "it does not say what to look for; write .*, such as hwgrep://CH340$",
    "hwgrep://CH340&n=one": "'n=one' is no option of hwgrep://; its options are n=2 .* skip_busy$",
    "hwgrep://CH340&n=1": "'n=1' is no option of hwgrep://",
    "loop://?logging=loud": "'logging=loud' is no option of loop://; its options are logging=",
    "socket://board:1?logging=loud": "'logging=loud' is no option of socket://",
    "rfc2217://board:1?timeout=inf": "'timeout=inf' is no option of rfc2217://; .* timeout=5 and",
    "rfc2217://board:1?poll_modem&x": "'x' is no option of rfc2217://",
    "carrier-pigeon://coop": "nothing is known that begins with carrier-pigeon://; name a port",
    "spy://loop://?file=all.log": "would write to any file .*; name the port alone, and record it",
    "socket://": "it names no host; write socket://HOST:PORT",
    "socket://:4000": "it names no host; write socket://HOST:PORT",
    "socket://a..b:4000": r"'a\.\.b' is no host name; write socket://HOST:PORT",
    "socket://board": "it names no TCP port; write socket://HOST:PORT",
    "socket://[::1]": "it names no TCP port; write socket://HOST:PORT",
    "socket://board:": "it names no TCP port; write socket://HOST:PORT",
    "socket://[::1": "it is no address .*; write socket://HOST:PORT",
    "socket://board:http": "'http' is no TCP port, which is a number; write",
    "socket://board:99999": "99999 is no TCP port, which is 1 to 65535; write socket://HOST:PORT",
    "socket://board:0": "0 is no TCP port, which is 1 to 65535",
    "rfc2217://board:99999": "99999 is no TCP port, which is 1 to 65535; write rfc2217://HOST:PORT",
    f"socket://board:{'9' * 5000}": "is no TCP port, which is 1 to 65535",
}


@in_turn(
    "port, error, advice",
    lambda: [
        ("/dev/ttyNoSuchPort", PortNotFoundError, "exist|plugged in"),
        ("COM999", PortNotFoundError, "exist|plugged in"),
        ("hwgrep://no such adapter", PortNotFoundError, "'no such adapter' in its description"),
        ("socket://127.0.0.1:1", PortNotFoundError, r"reached \(.*\); see that .* and listening"),
        ("SOCKET://127.0.0.1:1?logging=error", PortNotFoundError, "there and listening"),
        ("hwgrep://.*&n=99", PortNotFoundError, "in its description, or none that 'n=99' leaves;"),
        (" /dev/ttyUSB0", PortNotFoundError, "its name begins or ends with a blank"),
        ("rfc2217://127.0.0.1:1", busservo.TransportError, "rfc2217://127.0.0.1:1"),
        ("rfc2217://nowhere", busservo.TransportError, "rfc2217://nowhere"),
        ("cp2110://", busservo.TransportError, "cp2110://"),
        ("socket:board:4000", PortNotFoundError, "and an address begins with socket://"),
        ("/", PortAddressError, "it is there, and is no serial port"),
        (__file__, PortAddressError, "it is there, and is no serial port"),
        ("bad\0name", PortAddressError, "name a port"),
        (None, PortAddressError, "name a port"),
        (7, PortAddressError, "name a port"),
        *((name, PortAddressError, expected) for name, expected in REFUSED_NAMES.items()),
    ],
)
def test_what_is_no_port_is_refused_with_advice(
    port: str, error: type[Exception], advice: str
) -> None:
    with pytest.raises(error, match=advice) as caught:
        open_transport(port)
    assert isinstance(caught.value, busservo.TransportError)
    assert caught.value.port == (str(port) if str(port).strip() else repr(port))


@in_turn(
    "port, platform, expected",
    lambda: [
        ("COM5", "linux", "that is how Windows names ports, and this is Linux"),
        ("com12", "darwin", "that is how Windows names ports, and this is macOS"),
        ("/dev/ttyUSB0", "win32", "that is how Linux names ports, and this is Windows"),
        ("/dev/ttyACM0", "darwin", "that is how Linux names ports, and this is macOS"),
        ("/dev/cu.usbserial-1410", "linux", "that is how macOS names ports, and this is Linux"),
        ("COM5", "win32", "there is no such port"),
        ("/dev/ttyUSB0", "linux", "there is no such port"),
        ("/dev/cu.usbserial-1410", "darwin", "there is no such port"),
        ("COMMUNE", "linux", "there is no such port"),
    ],
)
def test_a_port_name_of_another_system_is_recognized(
    port: str, platform: str, expected: str
) -> None:
    absent = serial.SerialException(2, f"could not open port {port}")
    error = not_opened(
        port, absent, lambda: "no serial port is plugged in", baud=9600, platform=platform
    )
    assert str(error) == f"{port}: {expected}; no serial port is plugged in"


@in_turn("baud", lambda: [0, -9600, float("nan"), 2**31])
def test_a_rate_that_no_port_has_is_refused(baud: float) -> None:
    with pytest.raises(ValueError, match="must be from 1 to 2147483647"):
        open_controller("loop://", baud=baud)


@in_turn(
    "error, expected",
    lambda: [
        (ValueError("Failed to set custom baud rate (77): [Errno 22] no"), "set to that rate (no)"),
        (serial.SerialException(36, "could not open port x: [Errno 36]"), os.strerror(36)),
        (serial.SerialException("Could not configure port: (5, 'no input')"), "opened (no input)"),
        (
            serial.SerialException("could not open port 'x': OSError(22, \"n'est pas\", None, 87)"),
            "it cannot be opened (n'est pas)",
        ),
        (serial.SerialException("it is too late"), "it cannot be opened (it is too late)"),
    ],
)
def test_an_error_has_the_words_of_the_system_and_not_those_of_pyserial(
    error: Exception, expected: str
) -> None:
    refused = str(not_opened("x", error, lambda: "these exist: y", baud=9600))
    assert expected in refused
    assert not any(word in refused for word in ("could not", "Could not", "Errno", "Failed"))


def test_an_error_at_opening_comes_with_advice_or_in_its_own_words(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise error

    monkeypatch.setattr(serial, "serial_for_url", fail)
    error = serial.SerialException(13, "could not open port /dev/ttyUSB0: Permission denied")
    with pytest.raises(busservo.PortPermissionError, match="dialout"):
        open_controller("/dev/ttyUSB0")
    error = serial.SerialException(5, "could not open port COM7: Input/output error")
    with pytest.raises(
        busservo.TransportError, match=r"it cannot be opened .*Input/output"
    ) as caught:
        open_transport("COM7")
    assert type(caught.value) is busservo.TransportError


def test_a_transport_on_its_own(board: VirtualController) -> None:
    transport = open_transport(board.port)
    assert transport.name == board.port
    assert transport.read(0.0) == b""
    transport.write(busservo.BatteryVoltageRead().encode())
    transport.drain(1)
    data = b""
    while len(data) < 6:
        data += transport.read(GENEROUS)
    assert data == busservo.BatteryVoltage(7500).encode()
    transport.close()
    transport.close()
    with pytest.raises(busservo.ClosedError):
        transport.read(1)
    with pytest.raises(busservo.ClosedError):
        transport.write(b"\x55")


@in_turn("port", lambda: ["a pseudo-terminal", "loop://"])
@in_turn("timeout", lambda: [0.0, 0.01, 0.12])
def test_a_read_waits_for_its_timeout(board: VirtualController, port: str, timeout: float) -> None:
    transport = open_transport(port if "://" in port else board.port)
    first = time.monotonic()
    taken = GENEROUS
    # A busy machine may be late at any time, but not each time.
    while taken >= timeout + 0.03 + timeout / 2:
        began = time.monotonic()
        assert began - first < GENEROUS, f"the shortest read took {taken} s"
        assert transport.read(timeout) == b""
        took = time.monotonic() - began
        assert took >= timeout
        taken = min(taken, took)
    transport.close()


@pytest.mark.parametrize("talk", PORT_TALKS)
def test_a_port_is_given_back_where_no_controller_can_be_made_of_it(
    board: VirtualController, talk: Talk
) -> None:
    with pytest.raises(ValueError, match="reply_timeout"):
        talk(board.port, None, reply_timeout=0)
    # Nobody has it: it can be had exclusively.
    with open_controller(board.port, **LIVE) as controller:
        assert controller.read_battery_voltage() == 7500


# ------------------------------------------------------------- drivers that cannot be had here
@dataclass
class Driver:
    """The part of a pyserial port that a test needs; its attributes say what it does."""

    error: Exception | None = None
    left: int = 0
    closing: Callable[[], object] = int
    closed: bool = False
    in_waiting = 0

    def _fail(self) -> None:
        if self.error is not None:
            raise self.error

    cancel_read = _fail

    @property
    def out_waiting(self) -> int:
        self._fail()
        self.left = max(0, self.left - 1)
        return self.left

    def write(self, data: bytes) -> int:
        self._fail()
        return len(data)

    def close(self) -> None:
        self.closing()
        self.closed = True
        self._fail()


def driven_by(driver: Driver) -> SerialPort:
    return SerialPort("COM7", driver, lambda: driven_by(driver))


def by_hid(driver: Driver) -> HidPort:
    return HidPort("hid://", driver, 64, lambda: by_hid(driver), CODEC)


class Trickling(Driver):
    """A port at which more bytes arrive while it is read."""

    arriving: ClassVar[list[int]] = []

    @property
    def in_waiting(self) -> int:  # type: ignore[override]
        return self.arriving.pop(0)

    def read(self, size: int) -> bytes:
        return b"U" * size


def test_what_arrives_during_a_read_is_read_as_well() -> None:
    Trickling.arriving = [3, 3, 2, 0]
    assert driven_by(Trickling()).read(0.01) == b"UUUUU"
    assert Trickling.arriving == []


def test_an_adapter_that_takes_no_more_bytes_is_reported_with_advice() -> None:
    port = driven_by(Driver(serial.SerialTimeoutException("Write timeout")))
    with pytest.raises(
        busservo.WriteStuckError, match="has taken no bytes for 1 s; unplug and replug"
    ):
        port.write(b"UU")


@dataclass
class Paused(Driver):
    """A port whose process stands still during each write, for longer than its timeout."""

    handle: int = 0
    most: int = 100
    clock: list[float] = field(default_factory=lambda: [0.0])
    taken: bytes = b""
    write_timeout: float | None = 1.0

    def fileno(self) -> int:
        return self.handle

    def write(self, data: bytes) -> int:
        self.taken += data[: self.most]
        self.clock[0] += 5.0
        if self.write_timeout:  # as pyserial, which looks at the clock before it looks at the port
            raise serial.SerialTimeoutException("Write timeout")
        return min(len(data), self.most)


@in_turn("most", lambda: [1, 2, 100])
def test_a_pause_of_the_process_is_no_adapter_that_takes_no_bytes(
    monkeypatch: pytest.MonkeyPatch, most: int
) -> None:
    one, other = socket.socketpair()
    with one, other:
        driver = Paused(handle=one.fileno(), most=most, clock=[100.0])
        monkeypatch.setattr(time, "monotonic", lambda: driver.clock[0])
        driven_by(driver).write(b"UU\x02\x0f")
    assert driver.taken == b"UU\x02\x0f"


def test_a_pause_in_front_of_an_adapter_that_takes_no_bytes_hides_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    one, other = socket.socketpair()
    with one, other:
        one.setblocking(False)
        with contextlib.suppress(BlockingIOError):
            while True:
                one.send(bytes(65536))
        monkeypatch.setattr("framewire.line.serial_port._WRITE_TIMEOUT", 0.01)
        port = driven_by(Paused(handle=one.fileno()))
        with pytest.raises(busservo.WriteStuckError, match="has taken no bytes"):
            port.write(b"UU\x02\x0f")


@in_turn("error", lambda: [OSError(5, "Input/output error"), TypeError("fd is None")])
def test_an_adapter_that_is_gone_is_lost_in_whatever_it_was_at(error: Exception) -> None:
    driver = Driver(error)
    port = driven_by(driver)
    with pytest.raises(busservo.DisconnectedError, match="reconnect"):
        port.write(b"UU")
    with pytest.raises(busservo.DisconnectedError, match="reconnect"):
        port.drain(1)
    port.close()
    assert driver.closed
    # Once it is closed at this end, that is what is said.
    with pytest.raises(busservo.ClosedError):
        port.drain(1)


def test_draining_waits_until_the_driver_has_sent_all_and_no_longer_than_its_timeout() -> None:
    driver = Driver()
    port = driven_by(driver)
    driver.left = 5
    port.drain(GENEROUS)
    assert driver.left == 0
    driver.left = 1_000_000
    began = time.monotonic()
    port.drain(0.02)
    assert 0.02 <= time.monotonic() - began < GENEROUS
    assert driver.left > 0
    port.close()


def test_a_port_is_closed_even_under_a_read_that_does_not_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    reading = Gate()

    class Stuck(Driver):
        @property
        def in_waiting(self) -> int:  # type: ignore[override]
            reading()
            raise OSError("gone")

    driver = Stuck()
    port = driven_by(driver)

    def read() -> None:
        with pytest.raises(busservo.ClosedError):
            port.read(0.01)

    pool = ThreadPoolExecutor()
    ended = pool.submit(read)
    reading.wait()
    acquire = port._reading.acquire

    class Impatient:
        """The lock, without the second that closing waits for it."""

        release = port._reading.release

        def acquire(self, timeout: float) -> bool:
            assert timeout == 1.0
            return acquire(timeout=0.01)

    monkeypatch.setattr(port, "_reading", Impatient())
    port.close()
    assert driver.closed
    reading.go_on.set()
    ended.result(GENEROUS)
    pool.shutdown()


@in_turn("made", lambda: [driven_by, by_hid])
def test_whoever_closes_a_port_second_waits_for_whoever_closes_it_first_but_not_for_itself(
    made: Callable[[Driver], SerialPort | HidPort],
) -> None:
    closing = Gate()
    driver = Driver(closing=closing)
    whoever_closes_second_waits(made(driver), closing, driver)
    driver = Driver()
    port = made(driver)
    driver.closing = port.close
    port.close()
    assert driver.closed


def test_a_pseudo_terminal_is_opened_though_it_keeps_no_parity(
    board: VirtualController, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(LINK, "parity", "even")
    with open_controller(board.port, **LIVE) as controller:
        assert controller.read_battery_voltage() == 7500
