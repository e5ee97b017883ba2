"""The verb `doctor`: what it prints, how it ends, and the report that it writes."""

import json
from pathlib import Path

import pytest
from busservo.__main__ import main
from busservo_simulator import Faults, VirtualController
from framewire.command import doctor
from framewire.command.checks import reply
from framewire.command.checks.check import Check
from framewire.command.checks.checks import examine
from framewire.command.checks.diagnosis import Diagnosis
from framewire.command.checks.report import Report
from framewire.command.checks.result import PASSED, Result, passed
from framewire.line.link_errors import DisconnectedError

from tests.lines.patient import ADAPTER, CHECKS, PORT, board_with, diagnosis_of, examined
from tests.timeouts import GENEROUS

Capture = pytest.CaptureFixture[str]

PATIENT = ("--timeout", str(GENEROUS))


@pytest.mark.usefixtures("nothing_else_comes")
def test_each_check_is_a_line_with_its_bytes_below_it(capsys: Capture) -> None:
    with VirtualController("tcp") as board:
        assert main(["doctor", "--port", board.port, *PATIENT]) == 0
        assert board.rejects.total == 0
    output, errors = capsys.readouterr()
    lines = output.splitlines()
    said = [line.split()[:2] for line in lines if not line.startswith(" ")]
    assert [name for _, name in said] == [check.id for check in CHECKS]
    assert "passed   echo         nothing of what is sent comes back" in lines
    assert "                bytes 55 55 04 0F 4C 1D" in lines
    assert " passed, 0 failed, " in errors


def test_a_value_that_no_source_judges_is_noted() -> None:
    with board_with(battery_mv=4700) as board:
        found = examined(diagnosis_of(board))["reply"]
    assert found.state == PASSED
    assert found.note.startswith("voltage_mv is 4700 mV = 4.700 V. Not known: Which voltage is")
    shown = doctor._as_text(reply.CHECK, found).splitlines()
    assert shown[1:] == [
        "                bytes 55 55 04 0F 5C 12",
        f"                 note {found.note}",
    ]


def test_a_failed_check_comes_with_advice(capsys: Capture) -> None:
    assert main(["doctor", "--port", "no-such-port"]) == 1
    output = capsys.readouterr().out
    assert "failed   opening      no-such-port: there is no such port\n" in output
    assert "                 next " in output
    assert "unknown  rate         not looked at: see the check `opening`\n" in output


@pytest.mark.usefixtures("nothing_else_comes")
def test_json_has_a_line_for_each_check(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "checks_of", lambda _: CHECKS[:7])
    with VirtualController("tcp") as board:
        assert main(["doctor", "--port", board.port, "--json", *PATIENT]) == 0
    records = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [record["check"] for record in records] == [check.id for check in CHECKS[:7]]
    assert all(
        [*record] == ["check", "title", "state", "seen", "bytes", "note", "next"]
        for record in records
    )
    (rate,) = [record for record in records if record["check"] == "rate"]
    assert rate["bytes"] == ["55 55 04 0F 4C 1D"]


@pytest.mark.usefixtures("nothing_else_comes")
def test_a_line_that_is_lost_has_a_status_of_its_own(capsys: Capture) -> None:
    with VirtualController("tcp", faults=Faults(hang_up=1.0)) as board:
        assert main(["doctor", "--port", board.port, *PATIENT]) == 3
    assert "failed   rate " in capsys.readouterr().out


# ------------------------------------------------------------------ reports


def report_of(diagnosis: Diagnosis, path: Path, model: str = "LSC-32") -> str:
    report = Report(path)
    findings = list(examine(diagnosis, CHECKS))
    report.write(diagnosis, findings, model)
    return path.read_text(encoding="ascii")


def test_a_report_is_a_recording_that_says_what_was_found(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "report.hex"
    with board_with(Faults(noise=0.5, unsolicited=0.3, seed=1), local_echo=True) as board:
        report = report_of(diagnosis_of(board), path)
    lines = report.splitlines()
    assert lines[0].startswith("# doctor of busservo ")
    assert "# device: LSC-32" in lines
    assert "# adapter: 1A86:7523 USB Serial" in lines
    assert "# line: a serial port, 9600 baud" in lines
    assert [line.split()[2] for line in lines if line[2:8] in {"passed", "failed"}][:3] == [
        "port:",
        "hid:",
        "permission:",
    ]
    assert main(["decode", str(path)]) == 0
    decoded = capsys.readouterr().out
    for each in ("BatteryVoltageRead", "BatteryVoltage voltage_mv", "noise", "ActionGroup"):
        assert each in decoded


def test_a_report_says_at_which_rate_each_question_was_sent(tmp_path: Path) -> None:
    with board_with(Faults(dropped=1.0)) as board:
        report = report_of(diagnosis_of(board), tmp_path / "report.hex")
    opened = [line for line in report.splitlines() if line.startswith("# opened, at ")]
    rates = (9600, 115200, 57600, 38400, 19200, 4800, 9600)
    assert opened == [f"# opened, at {rate} baud" for rate in rates]


def test_a_report_does_not_identify_its_sender(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No serial number, no name of a port, which may hold one, and no path of a home."""
    home = "/users/ada.lovelace"
    monkeypatch.setattr(Path, "home", lambda: Path(home))
    secret = ADAPTER._replace(name="/dev/cu.usbserial-A50285BI", product="FT232R A50285BI")
    for port in (f"{home}/board", secret.name, None):
        with board_with() as board:
            diagnosis = diagnosis_of(board, port=port, ports=lambda: [secret])
            report = report_of(diagnosis, tmp_path / f"{port}.hex".replace("/", "-"))
        for each in ("lovelace", "A50285BI", "usbserial", PORT):
            assert each not in report
    assert "FT232R SERIAL" in report


def test_a_report_of_no_port_at_all_is_one_too(tmp_path: Path) -> None:
    with board_with() as board:
        diagnosis = diagnosis_of(board, port=None, ports=list)
        report = report_of(diagnosis, tmp_path / "report.hex", "")
    assert "# device: not stated\n# adapter: not known\n" in report
    assert "# line: no port, 9600 baud\n# failed port: no serial port is plugged in\n" in report


def test_a_report_of_a_board_by_usb_hid_names_it(tmp_path: Path) -> None:
    from framewire.line.hid_devices import HidDevice  # noqa: PLC0415 - where it is used

    found = [HidDevice(0x0483, 0x5750, "/dev/hidraw0", "LOBOT")]
    with board_with() as board:
        diagnosis = diagnosis_of(board, port="hid://", hid_devices=lambda: found)
        report = report_of(diagnosis, tmp_path / "report.hex")
    assert "# adapter: 0483:5750 LOBOT\n" in report
    assert "# line: hid://, 9600 baud\n" in report


def test_a_report_is_never_overwritten(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "report.hex"
    path.write_text("55 55 02 07\n")
    assert main(["doctor", "--port", "no-such-port", "--report", str(path)]) == 2
    assert "never overwritten" in capsys.readouterr().err
    assert path.read_text() == "55 55 02 07\n"
    path.unlink()
    assert main(["doctor", "--port", "no-such-port", "--report", str(path)]) == 1
    assert "# failed opening: PORT: there is no such port" in path.read_text()


def test_a_report_is_written_even_where_it_was_ended_early(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(_: Diagnosis) -> Result:
        raise KeyboardInterrupt

    checks = [Check("one", "one", (), lambda _: passed("fine")), Check("two", "", (), interrupted)]
    monkeypatch.setattr(doctor, "checks_of", lambda _: checks)
    path = tmp_path / "report.hex"
    assert main(["doctor", "--port", "COM7", "--report", str(path)]) == 130
    assert "# passed one: fine\n" in path.read_text()


def test_whatever_ends_it_the_port_is_given_back() -> None:
    def lost(diagnosis: Diagnosis) -> Result:
        diagnosis.connect()
        raise DisconnectedError("COM7", "the line was lost", "reconnect()")

    with board_with() as board:
        diagnosis = diagnosis_of(board)
        list(examine(diagnosis, [Check("one", "one", (), lost)]))
    assert diagnosis.probe is None
