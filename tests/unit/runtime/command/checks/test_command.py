"""The verb `doctor`: what it prints, how it ends, the report that it writes, and what it moves."""

import math
import sys
from pathlib import Path

import pytest
from busservo.__main__ import main
from busservo._command import PROGRAM
from busservo._exchanges import POSE
from busservo_simulator import Faults, VirtualController, servo
from framewire.client.limits import Limits
from framewire.command import doctor
from framewire.command.checks import move
from framewire.command.checks.check import Check
from framewire.command.checks.checks import examine
from framewire.command.checks.diagnosis import Diagnosis
from framewire.command.checks.move import move_check
from framewire.command.checks.report import Report
from framewire.command.checks.result import FAILED, PASSED, UNKNOWN, Result, passed
from framewire.line.hid_devices import HidDevice
from framewire.line.link_errors import DisconnectedError

from tests.commands import records, run
from tests.lines.patient import ADAPTER, CHECKS, PORT, board_with, diagnosis_of
from tests.timeouts import GENEROUS

PATIENT = ("--timeout", GENEROUS)


@pytest.mark.usefixtures("nothing_else_comes")
def test_each_check_is_a_line_with_its_bytes_or_json(monkeypatch: pytest.MonkeyPatch) -> None:
    with VirtualController("tcp") as board:
        status, output, errors = run("doctor", "--port", board.port, *PATIENT)
        assert (status, board.rejects.total) == (0, 0)
    lines = output.splitlines()
    names = [line.split()[1] for line in lines if not line.startswith(" ")]
    assert names == [check.id for check in CHECKS]
    assert "passed   echo         nothing of what is sent comes back" in lines
    assert "                bytes 55 55 04 0F 4C 1D" in lines
    assert " passed, 0 failed, " in errors
    monkeypatch.setattr(doctor, "checks_of", lambda _: CHECKS[:7])
    with VirtualController("tcp") as board:
        found = records("doctor", "--port", board.port, "--json", *PATIENT)
    keys = ["check", "title", "state", "seen", "bytes", "note", "next"]
    assert [record["check"] for record in found] == [check.id for check in CHECKS[:7]]
    assert [[*record] for record in found] == 7 * [keys]
    (rate,) = [record for record in found if record["check"] == "rate"]
    assert rate["bytes"] == ["55 55 04 0F 4C 1D"]


@pytest.mark.usefixtures("nothing_else_comes")
def test_a_line_that_is_lost_has_a_status_of_its_own() -> None:
    with VirtualController("tcp", faults=Faults(hang_up=1.0)) as board:
        status, output, _ = run("doctor", "--port", board.port, *PATIENT)
    assert (status, "failed   rate " in output) == (3, True)


def test_whatever_ends_it_the_port_is_given_back() -> None:
    def lost(diagnosis: Diagnosis) -> Result:
        diagnosis.connect()
        raise DisconnectedError("COM7", "the line was lost", "reconnect()")

    with board_with() as board:
        diagnosis = diagnosis_of(board)
        list(examine(diagnosis, [Check("one", "one", (), lost)]))
    assert diagnosis.probe is None


# ------------------------------------------------------------------ reports
@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "report.hex"


def report_of(diagnosis: Diagnosis, path: Path, model: str = "LSC-32") -> str:
    path.unlink(missing_ok=True)
    Report(path).write(diagnosis, list(examine(diagnosis, CHECKS)), model)
    return path.read_text(encoding="ascii")


def test_a_report_is_a_recording_that_says_what_was_found(path: Path) -> None:
    with board_with(Faults(noise=0.5, unsolicited=0.3, seed=1), local_echo=True) as board:
        report = report_of(diagnosis_of(board), path)
    first, *lines = report.splitlines()
    assert first.startswith("# doctor of busservo ")
    for said in ("device: LSC-32", "adapter: 1A86:7523 USB Serial"):
        assert f"# {said}" in lines
    assert "# line: a serial port, 9600 baud" in lines
    checks = [line.split()[2] for line in lines if line[2:8] in {"passed", "failed"}]
    assert checks[:3] == ["port:", "hid:", "permission:"]
    status, decoded, _ = run("decode", path)
    assert status == 0
    for each in ("BatteryVoltageRead", "BatteryVoltage voltage_mv", "noise", "ActionGroup"):
        assert each in decoded


def test_a_report_says_at_which_rate_each_question_was_sent(path: Path) -> None:
    with board_with(Faults(dropped=1.0)) as board:
        report = report_of(diagnosis_of(board), path)
    opened = [line for line in report.splitlines() if line.startswith("# opened, at ")]
    rates = (9600, 115200, 57600, 38400, 19200, 4800, 9600)
    assert opened == [f"# opened, at {rate} baud" for rate in rates]


def test_a_report_does_not_identify_its_sender(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No serial number, no name of a port, which may hold one, and no path of a home."""
    home = "/users/ada.lovelace"
    monkeypatch.setattr(Path, "home", lambda: Path(home))
    secret = ADAPTER._replace(name="/dev/cu.usbserial-A50285BI", product="FT232R A50285BI")
    for port in (f"{home}/board", secret.name, None):
        with board_with() as board:
            report = report_of(diagnosis_of(board, port=port, ports=lambda: [secret]), path)
        for each in ("lovelace", "A50285BI", "usbserial", PORT):
            assert each not in report
    assert "FT232R SERIAL" in report


def test_a_report_of_no_port_or_of_a_board_by_usb_hid_says_so(path: Path) -> None:
    with board_with() as board:
        report = report_of(diagnosis_of(board, port=None, ports=list), path, "")
    assert "# device: not stated\n# adapter: not known\n" in report
    assert "# line: no port, 9600 baud\n# failed port: no serial port is plugged in\n" in report
    found = [HidDevice(0x0483, 0x5750, "/dev/hidraw0", "LOBOT")]
    with board_with() as board:
        report = report_of(diagnosis_of(board, port="hid://", hid_devices=lambda: found), path)
    assert "# adapter: 0483:5750 LOBOT\n" in report
    assert "# line: hid://, 9600 baud\n" in report


def test_a_report_is_never_overwritten(path: Path) -> None:
    path.write_text("55 55 02 07\n")
    status, _, errors = run("doctor", "--port", "no-such-port", "--report", path)
    assert (status, "never overwritten" in errors) == (2, True)
    assert path.read_text() == "55 55 02 07\n"
    path.unlink()
    assert run("doctor", "--port", "no-such-port", "--report", path).status == 1
    assert "# failed opening: PORT: there is no such port" in path.read_text()


def test_a_report_is_written_where_ended_early(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: Diagnosis) -> Result:
        raise KeyboardInterrupt

    checks = [Check("one", "one", (), lambda _: passed("fine")), Check("two", "", (), interrupted)]
    monkeypatch.setattr(doctor, "checks_of", lambda _: checks)
    assert run("doctor", "--port", "COM7", "--report", path).status == 130
    assert "# passed one: fine\n" in path.read_text()


# ------------------------------------------------------------------ what moves
OPENING = [check for check in CHECKS if check.id in {"port", "permission", "busy", "opening"}]


def moved(board: VirtualController, servo: int = 1) -> Result:
    assert POSE is not None
    checks = [*OPENING, move_check(servo, POSE)]
    found = {check.id: result for check, result in examine(diagnosis_of(board), checks)}
    return found["move"]


@pytest.mark.parametrize(("began", "reached"), [(500, 520), (0, 20), (990, 970), (1000, 980)])
def test_a_servo_goes_a_little_and_back(began: int, reached: int) -> None:
    with board_with() as board:
        board.servos[1].move(began, 0)
        board.advance(2)
        found = moved(board)
        assert board.servos[1].position == began
        assert not any(servo.travelling for servo in board.servos.values())
    report = f"servo 1 was at {began}, was sent to {reached}, and was then at {reached}"
    assert found == (PASSED, f"{report}; sent back, it is at {began}", (), "", "")


def test_it_moves_even_where_replies_are_lost() -> None:
    with board_with(Faults(dropped=0.3, seed=2)) as board:
        assert moved(board).state == PASSED


def test_a_missing_servo_is_not_moved() -> None:
    with board_with() as board:
        found = moved(board, 9)
        assert board.accepted == 1
        assert (found.state, found.advice) == (FAILED, "see the check `present`")
        board.servos[2].off = True
        assert "reports no position, so it was not moved" in moved(board, 2).seen
        assert board.accepted == 2


def test_what_is_outside_the_limits_is_not_moved(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(PROGRAM.library, "limits", Limits((0, 400)))
    with board_with() as board:
        found = moved(board)
        assert board.accepted == 1
    seen = "servo 1 is at 500, outside 0..400, so it was not moved"
    assert (found.state, found.seen) == (UNKNOWN, seen)


def test_a_servo_that_does_not_move_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    with board_with() as board:
        monkeypatch.setattr(board.servos[1], "move", lambda *_: None)
        found = moved(board)
    assert found.state == FAILED
    assert found.seen == "servo 1 was at 500, was sent to 520, and was then at 500"
    assert "supply" in found.advice


@pytest.mark.parametrize(("answer", "status"), [("y\n", 0), ("n\n", 2), ("\n", 2), ("", 2)])
@pytest.mark.usefixtures("nothing_else_comes")
def test_it_asks_before_it_moves(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], answer: str, status: int
) -> None:
    class Terminal:
        def isatty(self) -> bool:
            return True

        def readline(self) -> str:
            return answer

    monkeypatch.setattr(sys, "stdin", Terminal())
    monkeypatch.setattr(doctor, "checks_of", lambda _: OPENING)
    # It moves in no time, and so before its position is read, on however slow a machine.
    monkeypatch.setattr(servo, "STEPS_PER_SECOND", math.inf)
    monkeypatch.setattr(move, "_MILLISECONDS", 0)
    monkeypatch.setattr(move, "_AFTER", 0.0)
    words = ["--move", "1", "--timeout", str(GENEROUS)]
    with VirtualController("tcp") as board:
        assert main(["doctor", "--port", board.port, *words]) == status
        assert board.servos[1].position == 500
    output, errors = capsys.readouterr()
    question = "servo 1 will move by 20 steps and back; keep clear of it. Go on? [y/N] "
    assert errors.startswith(question)
    assert ("passed   move " in output) == (status == 0)
    assert ("nothing was moved" in errors) == (status == 2)
