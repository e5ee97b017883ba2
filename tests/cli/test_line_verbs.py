"""The verbs of the command that have to do with a line, against the virtual controller."""

import json
import subprocess
import sys

import pytest
from busservo.cli import main
from busservo_simulator import VirtualController


def test_a_reply_is_printed_as_decode_prints_it(capsys: pytest.CaptureFixture[str]) -> None:
    with VirtualController("tcp") as board:
        assert main(["send", "--port", board.port, "BatteryVoltageRead"]) == 0
    shown = "     0  controller  BatteryVoltage voltage_mv=7500 mV | 55 55 04 0F 4C 1D\n"
    assert capsys.readouterr().out == shown


def test_a_reply_can_be_json(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["ServoPositionsRead", "servo_ids=1", "--json"]
    with VirtualController("tcp") as board:
        assert main(["send", "--port", board.port, *words]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["fields"] == {"positions": [{"servo_id": 1, "position": 500}]}


def test_a_command_arrives_and_prints_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    with VirtualController("tcp") as board:
        assert main(["send", "--port", board.port, "ServoUnload", "servo_ids=1,2"]) == 0
        # Its answer proves that the command before it has been taken in.
        assert main(["send", "--port", board.port, "BatteryVoltageRead"]) == 0
        assert (board.servos[1].loaded, board.servos[3].loaded) == (False, True)
        assert board.rejects.total == 0
    assert "ServoUnload" not in capsys.readouterr().out


def test_silence_is_told_from_success(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["send", "--port", "loop://", "BatteryVoltageRead"]) == 1
    assert "no BatteryVoltage came" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["send", "--port", "no-such-port", "ActionGroupStop"], "there is no such port"),
        (["send", "--port", "gopher://x", "ActionGroupStop"], "it is no port"),
        (["send", "--port", "loop://", "ActionGroupStopped"], "is never sent from here"),
        (["send", "--port", "loop://", "ServoMov"], "did you mean ServoMove?"),
        (["send", "ActionGroupStop"], "--port"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_line(
    capsys: pytest.CaptureFixture[str], words: list[str], told: str
) -> None:
    assert main(words) == 2
    errors = capsys.readouterr().err
    assert told in errors
    assert "Traceback" not in errors


def test_ports_lists_or_says_that_there_are_none(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["ports"]) == 0
    output, errors = capsys.readouterr()
    assert output or errors == "no serial port is plugged in\n"


def test_simulate_hands_over(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["simulate", "--help"]) == 0
    assert "busservo-simulator --tcp 4000" in capsys.readouterr().out


def test_simulate_says_what_is_missing(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("busservo_simulator", "busservo_simulator.cli"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    monkeypatch.setattr(sys, "path", [])
    monkeypatch.setattr(sys, "meta_path", [])
    monkeypatch.setitem(sys.modules, "busservo_simulator", None)
    assert main(["simulate"]) == 2
    assert "is not installed here" in capsys.readouterr().err


@pytest.mark.parametrize("words", [["decode", "55"], ["encode", "ActionGroupStop"]])
def test_without_a_port_there_is_no_serial_and_no_thread(words: list[str]) -> None:
    program = (
        "import sys; from busservo.cli import main; "
        f"main({words!r}); print(sorted({{'serial', 'threading'}} & set(sys.modules)))"
    )
    done = subprocess.run(
        [sys.executable, "-S", "-c", f"import sys; sys.path[:] = {sys.path!r}; {program}"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines()[-1] == "[]"
