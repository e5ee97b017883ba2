"""The verb `monitor`, with a transport, a screen and clocks of our own."""

import argparse
import errno
import io
import json
import os
import sys
import time
from io import TextIOWrapper
from pathlib import Path
from typing import Any, cast

import busservo
import pytest
from busservo import ActionGroupRun, BatteryVoltage, BatteryVoltageRead, DisconnectedError
from busservo._command import PROGRAM
from busservo._library import CODEC
from framewire.command import monitor
from framewire.command.recorder import Recorder
from framewire.command.usage_error import UsageError

from tests.commands import Terminal, run
from tests.lines.timed_line import TimedLine


class Line(TimedLine):
    """A line that brings pieces of bytes, a second apart; then silence, then its end."""

    def __init__(self, *pieces: bytes, silence: int = 0) -> None:
        super().__init__()
        self.pieces = [*pieces, *silence * [b""]]
        self.now = 100.0

    def day(self) -> float:
        """Return a clock that began at 09:08:07."""
        return time.mktime((2026, 1, 2, 9, 8, 7, 0, 0, -1)) + self.now - 100

    def read(self, _timeout: float) -> bytes:
        self.now += 1
        if not self.pieces:
            raise DisconnectedError("COM7", "the line was lost", "plug it in")
        return self.pieces.pop(0)


FRAME = BatteryVoltage(7500).encode()
LINE = (FRAME, b"\x13" + FRAME, FRAME)


def watched(
    *words: str,
    line: Line | None = None,
    screen: io.StringIO | None = None,
    log: Path | None = None,
) -> list[str]:
    """Return the lines that a monitor shows until the line is lost."""
    parser = argparse.ArgumentParser()
    monitor.add_arguments(parser, PROGRAM)
    line, screen = line or Line(*LINE), screen or io.StringIO()
    arguments = parser.parse_args(["--port", "COM7", *words])
    watching = monitor.Monitor(arguments, screen, CODEC, clock=line.clock, day=line.day)
    with Recorder(log, CODEC) as recorder:
        recorder.begin("COM7", line.clock())
        try:
            watching.watch(line, recorder)
        except DisconnectedError:
            assert not line.pieces
    # It only listens.
    assert line.written == []
    return list(screen.getvalue().splitlines())


def events(*words: str, line: Line | None = None) -> list[str]:
    """Return the same without their times."""
    return [shown[14:] for shown in watched(*words, line=line)]


BATTERY = "controller  BatteryVoltage voltage_mv=7500 mV | 55 55 04 0F 4C 1D"
NOISE = "noise       bad header: a frame begins 55 55 | 13"


@pytest.mark.parametrize(("form", "seconds"), [("zero", [1, 2, 2, 3]), ("delta", [1, 1, 0, 1])])
def test_a_line_for_each_frame_and_for_noise(form: str, seconds: list[int]) -> None:
    said = zip(seconds, [BATTERY, NOISE, BATTERY, BATTERY], strict=True)
    assert watched("-t", form) == [f"    {at}.000000  {what}" for at, what in said]


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--only", "noise"], [NOISE]),
        (["--hide", "noise", "-n", "2"], [BATTERY, BATTERY]),
        (["--only", "battery-voltage", "-n", "1"], [BATTERY]),
        (["--only", "host"], []),
        (["--only", "controller", "--hide", "BatteryVoltage"], []),
    ],
)
def test_only_the_requested_messages_are_shown(words: list[str], expected: list[str]) -> None:
    assert events(*words) == expected


def test_a_frame_of_unknown_command_is_shown_as_one_and_as_noise() -> None:
    for only in ("unknown", "noise"):
        line = Line(bytes.fromhex("55 55 03 01 2A"), FRAME)
        shown = events("--only", only, line=line)
        assert shown == ["unknown     command=1 parameters=2A | 55 55 03 01 2A"]


BOTH = (
    BatteryVoltageRead().encode(),
    FRAME,
    busservo.ServoPositionsRead([1, 2]).encode()
    + busservo.ServoPositions([(1, 5), (2, 6)]).encode(),
    busservo.ServoMove(time_ms=9, targets=[(1, 2)]).encode(),
    ActionGroupRun(group=8, times=1).encode(),
    busservo.ServoUnload([1]).encode(),
)


def test_json_says_the_same() -> None:
    line = Line(ActionGroupRun(group=8, times=1).encode(), b"\x13\x55\x55\x03\x01\x2a" + FRAME)
    either, board = {"time": 2.0, "from": "either"}, {"time": 2.0, "from": "controller"}
    run_fields = {"fields": {"group": 8, "times": 1}, "hex": "55 55 05 06 08 01 00"}
    ways = ["host_to_controller", "controller_to_host"]
    unknown = {"reason": "unknown command", "command": 1, "parameters": "2A"}
    battery = {"fields": {"voltage_mv": 7500}, "hex": "55 55 04 0F 4C 1D"}
    shown = [json.loads(each) for each in watched("--direction", "any", "--json", line=line)]
    assert shown == [
        {
            "time": 1.0,
            "from": "either",
            "direction": ways[0],
            "message": "ActionGroupRun",
            **run_fields,
            "or": ["ActionGroupStarted"],
        },
        {**either, "noise": "13", "reason": "bad header"},
        {**either, "noise": "55 55 03 01 2A", **unknown},
        {**board, "direction": ways[1], "message": "BatteryVoltage", **battery},
    ]


def test_half_a_frame_is_given_up_when_the_line_is_quiet() -> None:
    shown = watched("-n", "2", line=Line(FRAME[:3], b"", FRAME))
    assert shown == [
        "    2.000000  noise       too short: the shortest frame has 4 bytes | 55 55 04",
        f"    3.000000  {BATTERY}",
    ]


def test_what_was_received_before_the_line_was_lost_is_kept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    log = tmp_path / "line.hex"
    shown = watched(line=Line(FRAME, FRAME[:5]), log=log)
    assert shown[1].endswith(" has 6 bytes | 55 55 04 0F 4C")
    assert log.read_text().splitlines()[2].startswith("55 55 04 0F 4C  # 3.000000 s, noise")
    assert capsys.readouterr().err == "11 bytes: 1 message, 5 bytes of noise\n"


@pytest.mark.parametrize("direction", ["controller", "any", "host"])
def test_decode_prints_of_the_log_what_the_monitor_printed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], direction: str
) -> None:
    log = tmp_path / "line.hex"
    pieces = (b"\x00\x55", *BOTH, b"\x13", FRAME[:4], b"", b"\x55\x55\x03\x01\x2a", *BOTH)
    words = ["--direction", direction]
    shown = watched(*words, line=Line(*pieces, silence=1), log=log)
    output = "".join(f"{line}\n" for line in shown)
    assert run("decode", *words, log) == (0, output, capsys.readouterr().err)


@pytest.mark.parametrize(
    ("variables", "coloured"),
    [
        ({"TERM": "xterm"}, True),
        ({"TERM": "xterm", "NO_COLOR": ""}, True),
        ({"TERM": "xterm", "NO_COLOR": "1"}, False),
        ({"TERM": "dumb"}, False),
    ],
)
def test_there_is_colour_on_terminals_that_take_it(
    monkeypatch: pytest.MonkeyPatch, variables: dict[str, str], *, coloured: bool
) -> None:
    kept = {name: os.environ[name] for name in os.environ if name not in ("NO_COLOR", "TERM")}
    monkeypatch.setattr(os, "environ", kept | variables)
    assert ("\x1b[31mnoise" in "\n".join(watched(screen=Terminal()))) == coloured
    assert not any("\x1b" in line for line in watched())
    assert not any("\x1b" in line for line in watched("--json", screen=Terminal()))


def test_a_long_wait_shows_progress(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    watched("--only", "noise", line=Line(b"", b"", FRAME, b"\x13" + FRAME))
    last = "nothing to show for 3 s (Ctrl-C ends); 6 bytes: 1 message, 0 bytes of noise"
    assert terminal.getvalue() == (
        "\rnothing received for 1 s (Ctrl-C ends)"
        "\rnothing received for 2 s (Ctrl-C ends)"
        f"\r{last}"
        f"\r{' ' * len(last)}  \r"  # before a line is shown; and with room for ^C
        "\r  \r13 bytes: 2 messages, 1 byte of noise; 1 line shown\n"
    )


def test_a_wait_is_no_wider_than_its_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(terminal, "fileno", lambda: 7)
    monkeypatch.setattr(os, "get_terminal_size", lambda _: os.terminal_size((20, 24)))
    watched(line=Line(silence=1))
    assert terminal.getvalue().startswith("\rnothing received \r")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="there is no full disk here")  # noqa: PTH110 - as short
def test_a_full_disk_is_reported() -> None:
    status, _, errors = run("monitor", "--port", "loop://", "--log", "/dev/full")
    assert status == 2
    assert errors.endswith("/dev/full cannot be written: No space left on device\n")


class FullDisk(io.StringIO):
    """A file whose last bytes no longer fit."""

    def close(self) -> None:
        super().close()  # or it would be closed, and fail, once more when it is collected
        raise OSError(errno.ENOSPC, "No space left on device")


def test_a_recording_whose_end_does_not_fit_is_reported(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "line.hex", CODEC)
    assert recorder._file is not None
    recorder._file._file.close()
    recorder._file._file = cast("TextIOWrapper[Any]", FullDisk())
    with pytest.raises(UsageError, match=r"line\.hex.*No space left"), recorder:
        pass
    # The first error is the one that is reported.
    with pytest.raises(DisconnectedError), recorder:
        raise DisconnectedError("COM7", "the line was lost", "plug it in again")
