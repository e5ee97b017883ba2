"""The transcripts in the Learn guides: of commands that wait for keys, or show times.

A transcript is a block of `text` that begins with a command. Numbers with a point are times or
rates, and differ; all else must be what is printed, but for lines left out with `...`.
"""

import argparse
import io
import re
import sys
from collections.abc import Mapping
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import pytest
from busservo import DisconnectedError
from busservo.__main__ import main
from busservo._command import PROGRAM
from busservo_simulator import VirtualController
from framewire.command import doctor, monitor
from framewire.command.checks.check import Check
from framewire.command.checks.checks import examine
from framewire.command.checks.result import Result
from framewire.command.recorder import Recorder
from framewire.line.serial_port import SerialPortSeen

from tests.commands import run
from tests.documents import ROOT
from tests.lines.patient import CHECKS, board_with, diagnosis_of
from tests.timeouts import GENEROUS, await_that
from tests.unit.runtime.command.checks.test_strangers import CASES, examined
from tests.unit.runtime.command.test_line_verbs import plugged_in
from tests.unit.runtime.command.test_monitor import Line

PLAN = (ROOT / "docs" / "README.md").read_text(encoding="utf-8")
LEARN = re.findall(r"\]\((\S+)\): ", PLAN.partition("## Learn")[2].partition("\n## ")[0])
BLOCK = re.compile(r"^```text\n\$ (.*?)^```$", re.MULTILINE | re.DOTALL)
PAGES = {page: (ROOT / "docs" / page).read_text(encoding="utf-8") for page in LEARN}
TEXTS = [(page, text) for page in LEARN for text in BLOCK.findall(PAGES[page])]
# By the page and the verb: the words behind it, and the lines that follow.
TRANSCRIPTS = {
    (page, text.split()[1]): (text.partition("\n")[0].split()[2:], text.partition("\n")[2])
    for page, text in TEXTS
}
PATIENT = ("--timeout", str(GENEROUS))


def test_every_transcript_is_held_to_what_is_printed() -> None:
    assert len(TRANSCRIPTS) == len(TEXTS)
    of_command = ("teach", "monitor", "doctor", "bench-line", "answer")
    assert TRANSCRIPTS.keys() == {
        *(("command.md", verb) for verb in of_command),
        *(("getting-started.md", "ports"), ("troubleshooting.md", "doctor")),
    }


def assert_agrees(page: str, verb: str, printed: str) -> None:
    """Assert that a transcript shows this, with times of its own."""
    pieces = re.split(r"^\.\.\.\n", TRANSCRIPTS[page, verb][1], flags=re.MULTILINE)
    pattern = r"(?:.*\n)*".join(map(re.escape, map(without_times, pieces)))
    assert re.fullmatch(pattern, without_times(printed)), printed


def without_times(text: str) -> str:
    return re.sub(r"[0-9:]*[0-9]+\.[0-9]+", "#", text)


def test_ports(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("serial.tools.list_ports.comports", plugged_in)
    assert run("ports").out == TRANSCRIPTS["getting-started.md", "ports"][1]


def test_bench_line() -> None:
    _, port, *words = TRANSCRIPTS["command.md", "bench-line"][0]
    with VirtualController("tcp", baud=9600) as board:
        ended = run("bench-line", "--port", board.port, *words, "-n", "2", *PATIENT)
    printed = re.sub(r"\b2 (requests|answered)", r"100 \1", ended.out.replace(board.port, port))
    assert_agrees("command.md", "bench-line", printed)


def test_doctor() -> None:
    with board_with(local_echo=True) as board:
        plugged_in = SerialPortSeen("COM7", "1A86:7523", "USB Serial", "")
        diagnosis = diagnosis_of(board, port=plugged_in.name, ports=lambda: [plugged_in])
        found = list(examine(diagnosis, CHECKS))
    assert_agrees("command.md", "doctor", said(dict(found)))


def test_doctor_before_another_device() -> None:
    results = examined(CASES["a GPS receiver"].device())
    printed = said({check: results[check.id] for check in CHECKS})
    assert_agrees("troubleshooting.md", "doctor", printed)


def said(found: Mapping[Check, Result]) -> str:
    """Return what the doctor prints of the results of its checks."""
    lines = [doctor._as_text(check, result) for check, result in found.items()]
    states = [result.state for result in found.values()]
    counts = [f"{states.count(each)} {each}" for each in ("passed", "failed", "unknown")]
    return "\n".join([*lines, ", ".join(counts), ""])


def test_monitor(capsys: pytest.CaptureFixture[str]) -> None:
    words, shown = TRANSCRIPTS["command.md", "monitor"]
    parser = argparse.ArgumentParser()
    monitor.add_arguments(parser, PROGRAM)
    line = Line(*map(bytes.fromhex, re.findall(r" \| ([0-9A-F ]+)$", shown, re.MULTILINE)))
    screen = io.StringIO()
    arguments, codec = parser.parse_args(words), PROGRAM.library.codec
    watching = monitor.Monitor(arguments, screen, codec, clock=line.clock, day=line.day)
    with Recorder(None, codec) as recorder, pytest.raises(DisconnectedError):
        watching.watch(line, recorder)
    assert_agrees("command.md", "monitor", screen.getvalue() + "^C\n" + capsys.readouterr().err)


def test_teach(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    words, shown = TRANSCRIPTS["command.md", "teach"]
    monkeypatch.chdir(tmp_path)
    with VirtualController("tcp", servos=[1, 2, 3]) as board:
        keyboard = Keyboard(shown, board)
        monkeypatch.setattr(sys, "stdin", keyboard)
        at = words.index("--port") + 1
        words = ["teach", *words[:at], board.port, *words[at + 1 :], *PATIENT, "--baud", "inf"]
        with redirect_stdout(keyboard.screen), redirect_stderr(keyboard.screen):
            assert main(words) == 0
    printed = keyboard.screen.getvalue()
    assert [line.rstrip() for line in printed.splitlines()] == shown.splitlines()


class Keyboard:
    """What is typed in a transcript, and the hands that turn servos before each Enter."""

    def __init__(self, shown: str, board: VirtualController) -> None:
        questions = r"^.*(?:\? \[y/N\]|ends:) ?(.*)$"
        self._typed = re.findall(questions, shown, re.MULTILINE)
        self.screen = io.StringIO()
        self._poses = [
            {int(servo): int(position) for servo, position in re.findall(r"(\d+):(\d+)", line)}
            for line in re.findall(r"^pose .*$", shown, re.MULTILINE)
        ]
        self._board = board

    def readline(self) -> str:
        """Return what is typed, which the terminal shows."""
        typed = f"{self._typed.pop(0)}\n"
        self.screen.write(typed)
        if typed == "\n":
            await_that(lambda: not self._board.servos[3].loaded)
            for servo, position in self._poses.pop(0).items():
                self._board.servos[servo].turn_by_hand(position)
        return typed
