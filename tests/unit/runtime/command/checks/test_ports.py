"""The doctor's checks of ports: which there are, who may use them, and their rates."""

from pathlib import Path
from typing import Any

import busservo
import pytest
from busservo import BatteryVoltage, PortBusyError, PortNotFoundError, PortPermissionError
from busservo_simulator import VirtualController
from framewire.command.checks import port_listed, rate
from framewire.command.checks.checks import examine
from framewire.command.checks.diagnosis import Diagnosis
from framewire.command.checks.result import FAILED, PASSED, UNKNOWN, Result
from framewire.line.hid_devices import HidDevice
from framewire.line.serial_port import SerialPortSeen

from tests.in_turn import in_turn
from tests.lines.patient import CHECKS, board_with, diagnosis_at, diagnosis_of, examined
from tests.timeouts import GENEROUS

BUILT_IN = SerialPortSeen("/dev/ttyS0", "", "")
ONE = SerialPortSeen("/dev/ttyUSB0", "1A86:7523", "USB Serial", "A50285BI")
OTHER = SerialPortSeen("/dev/ttyUSB1", "0403:6001", "FT232R", "B1")
BOARD = HidDevice(0x0483, 0x5750, "/dev/hidraw0", "LOBOT")
PLUG_IN = "USB HID devices have no serial port at all"


def assert_says(found: Result, state: str, seen: str, advice: str) -> None:
    assert found.state == state
    assert seen in found.seen
    assert advice in found.advice


@in_turn(
    "port, ports, hid, taken, state, seen, advice",
    lambda: [
        (None, [ONE, BUILT_IN], [], "/dev/ttyUSB0", PASSED, "/dev/ttyUSB0 (1A86:7523 USB S", ""),
        (None, [BUILT_IN], [], "/dev/ttyS0", UNKNOWN, "no port is plugged in by USB", PLUG_IN),
        (None, [BUILT_IN], [BOARD], "hid://", PASSED, "which has none: 0483:5750 LOBOT", ""),
        (None, [], [], None, FAILED, "no serial port is plugged in", PLUG_IN),
        (None, [], None, None, FAILED, "no serial port is plugged in", PLUG_IN),
        (None, [BUILT_IN, BUILT_IN], [], None, FAILED, "no port is plugged in by USB: ", PLUG_IN),
        (None, [ONE, OTHER], [], None, FAILED, "2 ports are plugged in: ", "--port NAME"),
        ("/dev/ttyUSB1", [ONE, OTHER], [], "/dev/ttyUSB1", PASSED, "0403:6001 FT232R", ""),
        ("socket://x:1", [], [], "socket://x:1", PASSED, "which nothing lists", ""),
        ("COM9", [ONE], [], "COM9", UNKNOWN, "COM9 is not among the ports", "name of your own"),
        ("COM9", [], [], "COM9", UNKNOWN, "that are listed (none)", "name of your own"),
    ],
)
def test_the_port_is_found_or_it_is_said_where_to_look(
    port: str | None,
    ports: list[SerialPortSeen],
    hid: list[HidDevice] | None,
    taken: str | None,
    state: str,
    seen: str,
    advice: str,
) -> None:
    with board_with() as board:
        diagnosis = diagnosis_of(board, port=port, ports=lambda: ports, hid_devices=lambda: hid)
        found = examined(diagnosis)["port"]
    assert diagnosis.port == taken
    assert_says(found, state, seen, advice)
    assert bool(found.advice) == (state != PASSED)


@pytest.mark.usefixtures("pty")
def test_a_link_is_what_it_leads_to(tmp_path: Path) -> None:
    device = tmp_path.resolve() / "ttyUSB0"
    device.touch()
    link = tmp_path / "arm"
    link.symlink_to(device)

    def found(port: Path | str, *ports: SerialPortSeen) -> tuple[str, str]:
        diagnosis = diagnosis_at(str(port), ports=lambda: [*ports], hid_devices=list)
        state, seen, *_ = port_listed.CHECK.look(diagnosis)
        return state, seen

    listed = ONE._replace(name=str(device))
    assert found(link, listed) == (PASSED, f"{link} is {listed}")
    assert found(link) == (UNKNOWN, f"{link} is not among the ports that are listed (none)")
    assert found("/dev/pts/no-such")[0] == UNKNOWN
    name = tmp_path / "board"
    with VirtualController("pty", link=name) as board:
        pty = name.resolve()
        what = "a pseudo terminal, which nothing lists: a program is behind it"
        assert found(board.port, ONE) == (PASSED, f"{name} is {pty}, {what}")
        assert found(pty, ONE) == (PASSED, f"{pty} is {what}")


@in_turn(
    "port, hid, state, seen, advice",
    lambda: [
        ("COM7", [], PASSED, "no USB HID device (0483:5750) is plugged in", ""),
        ("COM7", None, UNKNOWN, "without hidapi nothing shows", "pip install hidapi"),
        ("COM7", [BOARD], UNKNOWN, "0483:5750 LOBOT is plugged in", "and --port hid://"),
        ("hid://", [BOARD], PASSED, "0483:5750 LOBOT is plugged in", ""),
    ],
)
def test_a_board_without_a_serial_port_is_seen(
    port: str, hid: list[HidDevice] | None, state: str, seen: str, advice: str
) -> None:
    with board_with() as board:
        found = examined(diagnosis_of(board, port=port, hid_devices=lambda: hid))["hid"]
    assert_says(found, state, seen, advice)
    assert ("not seen on hardware yet" in found.seen) == (state == UNKNOWN and hid is not None)


@in_turn(
    "error, check, seen, advice",
    lambda: [
        (PortPermissionError("COM7", "permission is denied", "join"), "permission", "denied", "jo"),
        (PortBusyError("COM7", "it is in use", "close it"), "busy", "in use", "ModemManager"),
        (PortNotFoundError("COM7", "there is no such port", "look"), "opening", "no such", "look"),
    ],
)
def test_a_port_that_cannot_be_opened_is_reported_by_one_check(
    error: busservo.TransportError, check: str, seen: str, advice: str
) -> None:
    def opener(_port: str, _baud: float) -> Any:
        raise error

    with board_with() as board:
        found = examined(diagnosis_of(board, opener=opener))
    assert [name for name, result in found.items() if result.state == FAILED] == [check]
    assert_says(found[check], FAILED, seen, advice)
    assert_says(found["rate"], UNKNOWN, f"not looked at: see the check `{check}`", "")


def test_a_line_lost_during_the_checks_is_reported_as_lost() -> None:
    with board_with() as board:
        transport = board.open()
        board.unplug()
        diagnosis = diagnosis_of(board, opener=lambda *_: transport)
        found = examined(diagnosis)
    assert_says(found["silence"], FAILED, "", "cable")
    assert "reconnect" not in found["silence"].advice
    assert found["look-alike"].seen == "not looked at: see the check `silence`"
    assert diagnosis.lost


# ------------------------------------------------------------------ rates, on pseudo terminals
@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch, nothing_else_comes: None) -> None:
    """Shorten the waits: nothing here is late."""
    monkeypatch.setattr(rate, "EXTRA_TIME", 0.0)


@pytest.fixture
def pty() -> Any:
    return pytest.importorskip("pty", reason="there are pseudo-terminals only where there is a tty")


def rate_of(port: str, **more: Any) -> Any:
    diagnosis = diagnosis_at(port, ports=list, hid_devices=list, **more)
    checks = [check for check in CHECKS if check.id in {"port", "opening", "permission", "rate"}]
    return {check.id: result for check, result in examine(diagnosis, checks)}["rate"]


@pytest.mark.garbage
@pytest.mark.usefixtures("quick", "pty")
def test_the_rate_at_which_a_board_answers_is_found() -> None:
    with VirtualController("pty", baud=57600) as board:
        found = rate_of(board.port)
    seen = "BatteryVoltageRead was not answered at 9600 baud, but is at 57600"
    assert (found.seen, found.evidence) == (seen, (BatteryVoltage(7500).encode(),))
    assert_says(found, FAILED, seen, "--baud 57600")


@pytest.mark.garbage
@pytest.mark.usefixtures("nothing_else_comes", "pty")
def test_a_board_at_the_rate_of_the_protocol_is_at_no_other() -> None:
    with VirtualController("pty") as board:
        found = rate_of(board.port, reply_timeout=GENEROUS / 100)
    assert (found.state, found.seen) == (PASSED, "it answers at 9600 baud")


@pytest.mark.usefixtures("nothing_else_comes")
def test_a_connection_has_no_rate() -> None:
    with VirtualController("tcp") as board:
        found = rate_of(board.port, reply_timeout=GENEROUS)
    assert found.state == PASSED
    assert found.seen.startswith(
        "it answers, over a line on which no rate is set from here (socket:"
    )


def test_a_pseudo_terminal_may_have_no_rate_either(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where it leads to a board elsewhere, which answers at whatever rate."""
    monkeypatch.setattr(Diagnosis, "is_pseudo_terminal", True)
    with board_with() as board:
        found = examined(diagnosis_of(board))["rate"]
    assert_says(found, UNKNOWN, "it answers at 9600 baud and at 115200 baud alike", "")
