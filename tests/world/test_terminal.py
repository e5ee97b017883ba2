"""The verbs as people run them: on a terminal or in a pipe, with Ctrl-C, with cables that fail."""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from busservo import BatteryVoltage, open_controller
from busservo._exchanges import POSE
from busservo_simulator import VirtualController
from framewire.command.posefile import read_poses

if sys.platform != "linux":
    pytest.skip("terminals differ by system, and only Linux's are tried", allow_module_level=True)

from tests.lines.boards import no_board_refuses_anything
from tests.lines.terminal import OnTerminal, start
from tests.timeouts import GENEROUS, LIVE, await_that
from tests.unit.runtime.command.test_teach_and_play import PATIENT, poses_of

__all__ = ["no_board_refuses_anything"]

CTRL_C = b"\x03"
BATTERY = "BatteryVoltage voltage_mv=7500 mV | 55 55 04 0F 4C 1D"


@pytest.fixture
def board() -> Iterator[VirtualController]:
    """Yield a board behind a pty, present from the first moment on."""
    with VirtualController("pty") as board:
        yield board


def test_ctrl_c_ends_a_monitor_with_its_totals(board: VirtualController) -> None:
    with OnTerminal("monitor", "--port", board.port) as monitor:
        monitor.wait_for("nothing received for [0-9]+ s")
        board.report(BatteryVoltage(7500))
        monitor.wait_for(r"7500 mV \| 55 55 04 0F 4C 1D\r\n")
        monitor.wait_for("nothing to show for [0-9]+ s")
        monitor.type(CTRL_C)
        assert monitor.end() == 130
        first, totals, *rest = monitor.lines
        assert first.endswith(f"\x1b[32mcontroller\x1b[0m  {BATTERY}")
        assert totals == "6 bytes: 1 message, 0 bytes of noise"
        assert rest == [""]
    # The port has been given back: the next one has it, exclusively.
    with open_controller(board.port, **LIVE) as controller:
        assert controller.read_battery_voltage() == 7500


def test_sigterm_ends_a_monitor_as_cleanly(board: VirtualController) -> None:
    monitor = start("monitor", "--port", board.port)
    assert monitor.stdout is not None
    board.spurious_output(BatteryVoltage(7500).encode())
    monitor.stdout.readline()
    monitor.terminate()
    _, errors = monitor.communicate(timeout=GENEROUS)
    assert monitor.returncode == 143
    assert re.fullmatch("[0-9]+ bytes: [0-9]+ messages?, [0-9]+ bytes? of noise\n", errors)


@pytest.mark.parametrize("variable", [{"NO_COLOR": "1"}, {"TERM": "dumb"}])
def test_no_colour_where_none_is_wanted(board: VirtualController, variable: dict[str, str]) -> None:
    with OnTerminal("monitor", "--port", board.port, "-n", "1", **variable) as monitor:
        monitor.wait_for("nothing received")
        board.report(BatteryVoltage(7500))
        assert monitor.end() == 0
        assert monitor.lines[0].endswith(f"  controller  {BATTERY}")
        assert "\x1b" not in monitor.shown


def test_a_page_is_as_wide_as_the_terminal_and_has_coloured_headings() -> None:
    with OnTerminal("docs", "BatteryVoltage", COLUMNS="60") as docs:
        assert docs.end() == 0
        prose = docs.shown.partition("In Python")[0].replace("\r\n", "\n")
    assert prose.startswith("\x1b[36mBatteryVoltage\x1b[0m\n")
    widths = [len(re.sub(r"\x1b\[[0-9]*m", "", line)) for line in prose.split("\n")]
    assert 50 < max(widths) <= 60
    with OnTerminal("docs", "BatteryVoltage", NO_COLOR="1") as docs:
        assert docs.end() == 0
        assert "\x1b" not in docs.shown


def test_a_pipe_that_is_closed_ends_a_monitor(board: VirtualController, tmp_path: Path) -> None:
    log = tmp_path / "line.hex"
    monitor = start("monitor", "--port", board.port, "--log", str(log))
    # Opening a port throws away what has come before, in the middle of a frame or not.
    await_that(log.exists)
    board.spurious_output(BatteryVoltage(7500).encode())
    head = subprocess.run(
        ["/usr/bin/env", "head", "-n", "1"],
        stdin=monitor.stdout,
        capture_output=True,
        text=True,
        check=True,
    )
    assert monitor.stdout is not None
    monitor.stdout.close()
    assert monitor.wait(GENEROUS) == 141
    assert monitor.stderr is not None
    errors = monitor.stderr.read()
    monitor.stderr.close()
    assert "BatteryVoltage" in head.stdout
    assert "messages" in errors
    assert "Traceback" not in errors
    assert len(errors.splitlines()) == 1


@pytest.mark.parametrize("via", ["pty", "tcp"])
def test_a_lost_line_is_reported_and_the_log_is_kept(tmp_path: Path, via: str) -> None:
    log = tmp_path / "line.hex"
    with VirtualController("pty" if via == "pty" else "tcp") as board:
        monitor = start("monitor", "--port", board.port, "--log", str(log), "--json")
        assert monitor.stdout is not None
        # A TCP port receives nothing before it has accepted the client.
        await_that(lambda: log.exists() and getattr(board._end, "_guest", True))
        # In one piece: where the frame has been read, the half behind it has been, too.
        frame = BatteryVoltage(7500).encode()
        board.send_bytes(frame + frame[:3])
        first = monitor.stdout.readline()
        board.unplug()
        rest, errors = monitor.communicate(timeout=GENEROUS)
    assert monitor.returncode == 3
    assert "7500" in first
    assert '"noise": "55 55 04"' in rest
    assert "Traceback" not in errors
    totals, error = errors.splitlines()
    assert totals == "9 bytes: 1 message, 3 bytes of noise"
    assert error.startswith(f"busservo: error: {board.port if via == 'tcp' else '/dev/'}")
    assert error.endswith("check the cable and the power, then run this again")
    # A machine that paused before the line was lost has found it quiet, and says so.
    assert len([line for line in log.read_text().splitlines() if line != "# quiet"]) == 3


def test_a_reply_that_does_not_come_is_reported_in_place_of_the_progress() -> None:
    words = ("send", "--port", "loop://", "--local-echo", "BatteryVoltageRead", "--timeout", "0.1")
    with OnTerminal(*words) as send:
        assert send.end() == 1
        (errors, rest) = send.lines
        assert errors.startswith("no BatteryVoltage came within ")
        assert rest == ""


def test_send_shows_that_it_waits_and_ctrl_c_ends_it_on_a_line_of_its_own() -> None:
    words = ("send", "--port", "loop://", "--local-echo", "BatteryVoltageRead", "--timeout", "3600")
    with OnTerminal(*words) as send:
        send.wait_for("waiting for BatteryVoltage, [0-9]+ s")
        send.type(CTRL_C)
        assert send.end() == 130
        # Linux sends the signal first: then ^C may come when the line is cleared already.
        assert send.lines in (["", ""], ["^C", ""])


def test_ctrl_c_ends_a_replay_and_says_how_far_it_got(
    board: VirtualController, tmp_path: Path
) -> None:
    log = tmp_path / "line.hex"
    move = "55 55 08 03 01 E8 03 01 20 03"
    log.write_text(f"{move}  # 0.0 s, host: a\n{move}  # 3600.0 s, host: another\n")
    with OnTerminal("replay", str(log), "--port", board.port) as replay:
        replay.wait_for("1 of 2 sent, the next in 3[0-9]+ s")
        replay.type(CTRL_C)
        assert replay.end() == 130
        shown, totals, rest = replay.lines
        assert shown.endswith(f"ServoMove time_ms=1000 ms targets=1:800 | {move}")
        assert (
            totals
            == "1 of 2 frames sent, 10 bytes; came back: 0 bytes: 0 messages, 0 bytes of noise"
        )
        assert rest == ""
    await_that(lambda: board.accepted == 1)
    assert board.rejects.total == 0


def test_ctrl_c_ends_a_measurement_with_what_was_measured(board: VirtualController) -> None:
    words = ("bench-line", "--port", board.port, "-n", "1000000", "--timeout", str(GENEROUS))
    with OnTerminal(*words) as bench:
        bench.wait_for(r"[1-9][0-9]* of 1000000 requests")
        bench.type(CTRL_C)
        assert bench.end() == 130
        first, *rows, rest = bench.lines
    # What came too soon or to nothing may have rows of its own: a pty takes no time.
    values = {row[:18].strip(): row[18:] for row in rows}
    assert first.startswith(f"BatteryVoltageRead on {board.port}: ")
    assert values["the wire alone"] == "10.42 ms: 4 bytes there and 6 back, at 9600 baud"
    assert values["round trips"].startswith("min ")
    assert " a second, " in values["rate"]
    assert (values["errors"], rest) == ("none", "")


def test_a_measurement_ends_with_the_line_and_keeps_what_it_measured(
    board: VirtualController,
) -> None:
    words = ("bench-line", "--port", board.port, "-n", "1000000", "--timeout", str(GENEROUS))
    bench = start(*words, "--json")
    await_that(lambda: board.accepted >= 3)
    board.unplug()
    shown, errors = bench.communicate(timeout=GENEROUS)
    assert bench.returncode == 3
    assert '"question": "BatteryVoltageRead"' in shown
    assert "the line was lost" in errors
    assert "Traceback" not in errors


# A key that comes just before a program reads is seen when it has read.
@pytest.mark.parametrize(
    ("key", "status"), [(CTRL_C + b"\n", 130), (b"\x04", 0), (b"q\nn\n", 0), (b"Q\nyes\n", 0)]
)
def test_recorded_poses_are_kept_however_teach_ends(
    board: VirtualController, key: bytes, status: int, tmp_path: Path
) -> None:
    file = tmp_path / "poses.json"
    words = ("--ids", "1", *PATIENT)
    with OnTerminal("teach", str(file), "--port", board.port, *words) as teach:
        teach.wait_for(r"Go on\? \[y/N\] ")
        teach.type(b"y\n")
        teach.wait_for("ends: ")
        teach.type(b"\n")
        teach.wait_for("pose 1  1:500")
        teach.wait_for("ends: (?s:.*)ends: ")
        teach.type(key)
        assert teach.end() == status
    assert re.search("1 pose recorded; servo 1 (is limp|held)\r\n", teach.shown)
    assert [each.positions for each in read_poses(file, POSE, "busservo")] == [{1: 500}]


def test_ctrl_c_in_a_play_holds_what_moves(board: VirtualController, tmp_path: Path) -> None:
    file = tmp_path / "poses.json"
    file.write_text(poses_of({"positions": {"1": 1000, "2": 0}, "time_ms": 60000}))
    with OnTerminal("play", str(file), "--port", board.port, *PATIENT) as play:
        play.wait_for("pose 1  ServoMove")
        await_that(lambda: board.servos[1].travelling)
        play.type(CTRL_C)
        assert play.end() == 130
    assert "servos 1, 2 held" in play.shown
    assert "0 of 1 pose played" in play.shown
    assert not board.servos[1].travelling or board.servos[1].target < 600


def test_ctrl_c_holds_what_a_move_moves(board: VirtualController) -> None:
    words = ("1:1000", "2:0", "--in", "60s", "--port", board.port, *PATIENT)
    with OnTerminal("move", *words) as move:
        await_that(lambda: board.servos[1].travelling)
        move.type(CTRL_C)
        assert move.end() == 130
    assert re.search("servos 1, 2 held", move.shown)
    assert not board.servos[1].travelling or board.servos[1].target < 600
