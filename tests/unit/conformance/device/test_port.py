"""The port of a firmware test, and the error if it does not open."""

import errno
import json
import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import serial
from busservo_simulator import VirtualController
from framegen.cli import main
from framegen.conformance import firmware
from framegen.conformance.device import session
from framegen.conformance.device.port import open_port
from framegen.reading.yamltree import Unusable

from tests.factories import BUSSERVO
from tests.in_turn import in_turn
from tests.programs import ran
from tests.timeouts import GENEROUS, await_that, undoubted
from tests.unit.conformance.device.runs import model_of

Capture = pytest.CaptureFixture[str]

MODEL = model_of()
LINK = MODEL.spec.link
unix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


@pytest.fixture(autouse=True)
def _nothing_else_comes(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setattr(session, "_LISTENING", 0.001)
    with undoubted():
        yield


def ask(port: str, *words: str, timeout: float = GENEROUS) -> int:
    """Return a run in real time."""
    parser = ArgumentParser()
    firmware.add_arguments(parser)
    arguments = parser.parse_args(["--port", port, *words])
    arguments.format, arguments.timeout = "text", timeout
    return firmware.run(MODEL, arguments)


@pytest.mark.parametrize("via", [pytest.param("pty", marks=unix), "tcp"])
def test_the_simulator_passes_through_a_port(via: Any, capsys: Capture) -> None:
    with VirtualController(via, servos=[1, 2]) as board:
        assert ask(board.port) == 0
    out = capsys.readouterr().out
    assert f"controller at {board.port}, 9600 8N1\n" in out
    assert out.endswith("8 of 8 steps passed\n")


@unix
@pytest.mark.garbage
def test_a_line_at_another_rate_is_reported(capsys: Capture) -> None:
    with VirtualController("pty", baud=9600) as board:
        assert ask(board.port, "--baud", "19200", timeout=0.01) == 1
        await_that(lambda: board.rejects.total)
    out = capsys.readouterr().out
    assert f"controller at {board.port}, 19200 8N1\n" in out
    assert "FAIL     BatteryVoltageRead, example 1\n" in out


def test_the_command_tests_firmware(capsys: Capture, tmp_path: Path) -> None:
    log = str(tmp_path / "run.hex")
    with VirtualController("tcp") as board:
        words = [str(BUSSERVO), "--port", board.port, "--format", "json", "--log", log]
        words += ["--timeout", str(GENEROUS)]
        assert main(["conform", *words]) == 0
        assert json.loads(capsys.readouterr().out)["passed"]
        assert main(["conform", *words]) == 2
    printed = capsys.readouterr().err
    assert printed.startswith("framegen: error: ")
    assert "a recording is never overwritten\n  hint: give another name, or remove it\n" in printed


# What is said of a command line, and how to mend it.
SLIPS = [
    (["--log", "run.hex"], "--log is for firmware", "name its port, as by --port COM5"),
    (["--local-echo"], "--local-echo is for firmware", "name its port, as by --port COM5"),
    (["--address", "0"], "--address is for firmware", "name its port, as by --port COM5"),
    (["--malformed", "--questions"], "--malformed is for firmware", "name its port"),
    (["--allow", "ServoMove", "--", "x"], "--allow is for firmware", "name its port"),
    (["--port", "", "--allow", "x"], "there is no message `x`", "choose one of `ServoMove`"),
    (["--port", ""], "'' is no port", "name a port, such as"),
    (["--port", "x", "--format", "badge"], "there is no badge for firmware", "--format text or"),
]


@in_turn("words, problem, hint", lambda: SLIPS)
def test_a_mistake_in_the_command_line_is_reported(
    words: list[str], problem: str, hint: str, capsys: Capture
) -> None:
    assert main(["conform", str(BUSSERVO), *words]) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith(f"framegen: error: {problem}")
    assert f"\n  hint: {hint}" in printed.err
    assert printed.out == ""


def test_a_device_that_hangs_up_is_reported() -> None:
    with VirtualController("tcp") as board:
        transport = open_port(board.port, LINK, 9600)
        assert transport.read(0.0) == b""
    with pytest.raises(OSError, match="the line was lost"):
        transport.read(1.0)
    transport.close()


def raises(error: Exception) -> Any:
    def refuse(*_: object, **__: object) -> None:
        raise error

    return refuse


# What pyserial raises for a port, what is said, and what to do.
NO_ENTRY = serial.SerialException(errno.ENOENT, "could not open port: No such file")
DENIED = serial.SerialException(errno.EACCES, "could not open port: Permission denied")
LOCKED = serial.SerialException(errno.EAGAIN, "Could not exclusively lock port")
NO_TTY = serial.SerialException("Could not configure port: (25, 'Inappropriate ioctl for device')")
NO_RATE = ValueError("Not a valid baudrate: 1")
BUSY = "/dev/it is in use"
REFUSED = BUSY if sys.platform == "win32" else "/dev/it: permission is denied"
OTHERS = ("these exist: ", "no serial port is plugged in")
ERRORS = [
    (NO_ENTRY, "there is no port /dev/it", OTHERS),
    (DENIED, REFUSED, ("close the other program", "add yourself to the group that owns it")),
    (LOCKED, BUSY, ("close the other program that has it",)),
    (NO_TTY, "/dev/it is no serial port", OTHERS),
    (NO_RATE, "/dev/it is no serial port: Not a valid baudrate: 1", OTHERS),
]


@pytest.mark.parametrize(("error", "problem", "hints"), ERRORS, ids=lambda each: str(each)[:30])
def test_a_port_that_does_not_open_is_reported(
    error: Exception, problem: str, hints: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(serial, "serial_for_url", raises(error))
    with pytest.raises(Unusable) as caught:
        open_port("/dev/it", LINK, 9600)
    assert str(caught.value).startswith(problem)
    assert caught.value.hint.startswith(hints)


# Names that are none, what is said, and what to do.
NAMED = "name a port, such as /dev/ttyUSB0 or COM7"
REACHED = "see that the address is right, and that the other end is there"
NAMES = [
    ("", "'' is no port that can be tested", NAMED),
    ("spy:///dev/null?file=a", "is no port that can be tested", NAMED),
    ("hid://", "is no port that can be tested", NAMED),
    ("nothing://x", "nothing://x cannot be reached: invalid URL", REACHED),
    ("socket://127.0.0.1:1", "socket://127.0.0.1:1 cannot be reached: ", REACHED),
    ("socket://here:99999", "socket://here:99999 is no address: Port out of", "write socket://HOS"),
    ("socket://here", "is no address: it lacks a host or its TCP port", "write socket://HOST:PORT"),
    ("rfc2217://:4000", "is no address: it lacks a host or", "write rfc2217://HOST:PORT"),
]


@in_turn("name, problem, hint", lambda: NAMES)
def test_an_invalid_port_name_is_refused(name: str, problem: str, hint: str) -> None:
    with pytest.raises(Unusable) as caught:
        open_port(name, LINK, 9600)
    assert problem in str(caught.value)
    assert caught.value.hint.startswith(hint)


@unix
def test_a_missing_port_a_file_and_a_port_in_use_are_reported(tmp_path: Path) -> None:
    file = tmp_path / "file"
    file.touch()
    with VirtualController("pty") as board:
        held = open_port(board.port, LINK, 9600)
        for port, why in (
            ("/dev/nowhere", "there is no port /dev/nowhere"),
            (str(file), "is no serial port"),
            (board.port, "is in use"),
        ):
            with pytest.raises(Unusable, match=why):
                open_port(port, LINK, 9600)
        held.close()


def test_without_pyserial_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "serial", None)
    with pytest.raises(Unusable, match="a port needs `pyserial`") as caught:
        open_port("/dev/it", LINK, 9600)
    assert caught.value.hint == "pip install 'pyserial>=3.5,<4'"


def test_the_parameters_of_the_line_are_the_specs(monkeypatch: pytest.MonkeyPatch) -> None:
    given: dict[str, Any] = {}
    real = serial.serial_for_url

    def note(_name: str, **options: Any) -> Any:
        given.update(options)
        return real("loop://", do_not_open=True)

    link = LINK.model_copy(update={"data_bits": 7, "parity": "even", "stop_bits": 2})
    monkeypatch.setattr(serial, "serial_for_url", note)
    open_port("/dev/it", link, 19200)
    chosen = {name: given[name] for name in ("baudrate", "bytesize", "parity", "stopbits")}
    assert chosen == {"baudrate": 19200, "bytesize": 7, "parity": "E", "stopbits": 2}


@pytest.mark.parametrize("text", ["0", "fast", "-1", "²", "1e4", "9" * 40])
def test_an_invalid_rate_is_refused(text: str, capsys: Capture) -> None:
    with pytest.raises(SystemExit):
        ask("/dev/it", "--baud", text)
    assert "is no rate: a whole number of baud, from 1 up" in capsys.readouterr().err


def test_pyserial_is_imported_only_for_a_port() -> None:
    look = "import sys, framegen.conformance.firmware; print('serial' in sys.modules)"
    assert ran(sys.executable, "-c", look).stdout == "False\n"
