"""The verb `replay`: what it sends, what it leaves out, and what it refuses before it sends."""

import io
import re
import socket
import sys
import time
from pathlib import Path
from unittest import mock

import pytest
from busservo import (
    ActionGroupRun,
    BatteryVoltageRead,
    Message,
    Noise,
    ServoMove,
    ServoPositionsRead,
    ServoUnload,
    open_controller,
)
from busservo.__main__ import main
from busservo_simulator import Faults, VirtualController
from framewire.command import link, playback
from framewire.command.playback import Playback

from tests.timeouts import GENEROUS, await_that

Capture = pytest.CaptureFixture[str]

MOVE = ServoMove(time_ms=100, targets=[(1, 600)])
ASK = BatteryVoltageRead()
READ = ServoPositionsRead([1])
RUN = ActionGroupRun(group=8, times=1)
# What no recording holds.
LAST = ServoPositionsRead([200])


@pytest.fixture(autouse=True)
def _no_answer_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(playback, "_QUIET", 0.0)


def prolong_waits(monkeypatch: pytest.MonkeyPatch, *counts: int) -> None:
    """Let each wait of a replay go on until so many lines are shown, on however slow a machine."""
    wait, lines = Playback._wait, iter(counts)

    def wait_longer(self: Playback, until: float, what: str) -> None:
        wait(self, until, what)
        enough = next(lines)
        await_that(lambda: self._lines.count >= enough or wait(self, time.monotonic() + 0.01, what))

    monkeypatch.setattr(Playback, "_wait", wait_longer)


def hexed(message: Message) -> str:
    return message.encode().hex(" ")


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "line.hex"


def replayed(log: Path, *words: str) -> tuple[int, list[Message | Noise]]:
    """Replay, and return the exit status and the messages that a board received."""
    received: list[Message | Noise] = []
    with (
        VirtualController("tcp") as board,
        mock.patch.object(board.board, "accepted", received.append),
        mock.patch.object(board.board, "rejected", received.append),
    ):
        status = main(["replay", str(log), "--port", board.port, *words])
        # The next client is let in once all has been received that was sent before.
        address = ("127.0.0.1", int(board.port.rpartition(":")[2]))
        with socket.create_connection(address, GENEROUS) as caller:
            caller.sendall(LAST.encode())
            await_that(lambda: LAST in received)
    assert received.pop() == LAST
    return status, received


def test_a_trace_of_a_client_is_played_without_what_came_back(
    log: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Before each of the three, and behind them for both answers.
    prolong_waits(monkeypatch, 0, 0, 0, 5)
    with (
        VirtualController("tcp") as board,
        open_controller(board.port, reply_timeout=GENEROUS, trace=log) as controller,
    ):
        controller.move_servos([(1, 600)], time_ms=100)
        board.send_bytes(b"\x13")
        controller.read_battery_voltage()
        controller.read_servo_positions([1])
    status, received = replayed(log)
    assert (status, received) == (0, [MOVE, ASK, READ])
    output, errors = capsys.readouterr()
    assert "host        BatteryVoltageRead | 55 55 02 0F\n" in output
    assert re.search(r"  controller  BatteryVoltage voltage_mv=.* \| 55 55 04 0F", output)
    first, totals = errors.splitlines()
    assert first == "left out: 2 frames of controller, 1 piece of noise"
    assert totals.startswith("3 of 3 frames sent, 20 bytes; came back: 14 bytes: 2 messages")


def test_a_log_of_a_monitor_is_played(log: Path) -> None:
    log.write_text(
        "# recorded of 'COM7' from 2026-01-02 on\n"
        f"{hexed(MOVE)}  # 0.5 s, host: ServoMove(...)\n\n"
        "55 55 04  # 0.6 s, controller noise: too short\n# quiet\n"
        f"{hexed(ASK)}  # 0.7 s, host: BatteryVoltageRead()\n"
    )
    assert replayed(log) == (0, [MOVE, ASK])


def test_a_lost_line_ends_the_replay_and_the_progress_is_reported(
    log: Path, capsys: Capture
) -> None:
    log.write_text(f"{hexed(ASK)}  # 0 s, host: a\n{hexed(ASK)}  # 9 s, host: b\n")
    with VirtualController("tcp", faults=Faults(hang_up=1.0)) as board:
        assert main(["replay", str(log), "--port", board.port]) == 3
    totals, error = capsys.readouterr().err.splitlines()
    assert totals.startswith("1 of 2 frames sent, 4 bytes; came back: ")
    assert "the line was lost" in error


def test_half_a_frame_that_comes_back_is_given_up_when_the_line_is_quiet(
    log: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The second is sent once the half frame has been shown, and its answer is waited for.
    prolong_waits(monkeypatch, 0, 2, 4)
    log.write_text(f"{hexed(MOVE)}  # 0 s, host: a\n{hexed(ASK)}  # 0.1 s, host: b\n")
    with VirtualController("tcp") as board:

        def begin(_: ServoMove) -> None:
            board.send_bytes(bytes.fromhex("55 55 04"))

        with mock.patch.object(board.board, "on_servo_move", begin):
            assert main(["replay", str(log), "--port", board.port]) == 0
    said = [line[14:].partition(" ")[0] for line in capsys.readouterr().out.splitlines()]
    assert said == ["host", "noise", "host", "controller"]


@pytest.mark.parametrize("raw", [True, False])
def test_raw_bytes_and_plain_hex_are_played(log: Path, *, raw: bool) -> None:
    data = MOVE.encode() + ASK.encode()
    # Pasted hex may break its lines anywhere.
    log.write_bytes(data if raw else (data.hex(" ")[:14] + "\n" + data.hex(" ")[14:]).encode())
    assert replayed(log) == (0, [MOVE, ASK])


def test_standard_input_is_played(monkeypatch: pytest.MonkeyPatch) -> None:
    class Input:
        buffer = io.BytesIO(ASK.encode())

    monkeypatch.setattr(sys, "stdin", Input())
    with VirtualController("tcp") as board:
        assert main(["replay", "-", "--port", board.port]) == 0
        assert (board.accepted, board.rejects.total) == (1, 0)


@pytest.mark.parametrize(
    ("speed", "times"),
    [
        ([], ["0.000000", "0.500000", "0.504167"]),
        (["--speed", "2"], ["0.000000", "0.250000", "0.254167"]),
        (["--speed", "0.5"], ["0.000000", "1.000000", "1.004167"]),
        # As fast as the line can: ten bytes of ten bits at 9600 baud, then four.
        (["--speed", "inf"], ["0.000000", "0.010417", "0.014583"]),
    ],
)
def test_a_replay_keeps_the_recorded_pace_or_that_of_the_line(
    log: Path, capsys: Capture, speed: list[str], times: list[str]
) -> None:
    log.write_text(
        f"{hexed(MOVE)}  # 3.5 s, host: a\n"
        f"{hexed(ASK)}  # 4.0 s, host: b\n"
        f"{hexed(READ)}  # 4.0 s, host: at once, which no line can carry\n"
    )
    assert main(["replay", str(log), "--dry-run", *speed]) == 0
    output, errors = capsys.readouterr()
    assert [line.split()[0] for line in output.splitlines()] == times
    assert (
        errors
        == f"3 frames, 20 bytes in {float(times[-1]) + 6 * 10 / 9600:.3f} s: nothing was sent\n"
    )


def test_the_pace_is_kept_on_a_port(log: Path, capsys: Capture) -> None:
    log.write_text(f"{hexed(ASK)}  # 1 s, host: a\n{hexed(ASK)}  # 1.4 s, host: b\n")
    assert replayed(log, "--speed", "2") == (0, [ASK, ASK])
    sent = [line for line in capsys.readouterr().out.splitlines() if " host " in line]
    first, second = (float(line.split()[0]) for line in sent)
    assert 0 <= first < first + 0.19 <= second < GENEROUS


EITHER = f"{hexed(RUN)}  # 0.1 s, either: ActionGroupRun(...) or ActionGroupStarted\n"


@pytest.mark.parametrize(
    ("text", "words", "received"),
    [
        (f"{EITHER}{hexed(ASK)}  # 1 s, host: b\n", ["--either", "send"], [RUN, ASK]),
        (f"{EITHER}{hexed(ASK)}  # 1 s, host: b\n", ["--either", "skip"], [ASK]),
        (hexed(RUN) + hexed(ASK), ["--either", "skip"], [ASK]),
        (hexed(RUN) + hexed(ASK), ["--direction", "host"], [RUN, ASK]),
        (f"13 {hexed(ASK)}", ["--skip-noise"], [ASK]),
        (
            f"13  # 0 s, host noise: bad header\n{hexed(ASK)}  # 1 s, host: b\n",
            ["--skip-noise"],
            [ASK],
        ),
        # It was no frame when it was received, and so it is none now.
        (
            f"{hexed(MOVE)}  # 0 s, host noise: cut\n{hexed(ASK)}  # 1 s, host: b\n",
            ["--skip-noise"],
            [ASK],
        ),
        ("55 55 02 0F 55 55 02 0F 55 55 04 0F 4C 1D", [], [ASK, ASK]),
    ],
)
def test_ambiguous_frames_are_sent_on_request(
    log: Path, text: str, words: list[str], received: list[Message]
) -> None:
    log.write_text(text)
    assert replayed(log, "--speed", "inf", *words) == (0, received)


def test_received_frames_may_be_recorded_out_of_order(log: Path) -> None:
    log.write_text(
        f"{hexed(MOVE)}  # 2 s, host: a\n55 55 04 0F 4C 1D  # 1 s, controller: late\n"
        f"13  # 0.5 s, noise: bad header\n{hexed(ASK)}  # 2 s, host: b\n"
    )
    assert replayed(log) == (0, [MOVE, ASK])


@pytest.mark.garbage
def test_raw_sends_every_byte_whoever_sent_it(log: Path) -> None:
    log.write_text(
        f"13  # 0 s, noise: bad header\n{EITHER}{hexed(ServoUnload([1]))}  # 1 s, controller: no!\n"
    )
    status, received = replayed(log, "--raw", "--speed", "inf")
    assert status == 0
    assert [type(event) for event in received] == [Noise, ActionGroupRun, ServoUnload]


@pytest.mark.parametrize(
    ("text", "words", "expected"),
    [
        (EITHER, [], "line 1: it is ActionGroupRun or ActionGroupStarted group=8 times=1, and not"),
        (hexed(RUN), [], "byte 0: it is ActionGroupRun or ActionGroupStarted"),
        (f"{hexed(ASK)} 13", [], "byte 4: it is no frame (bad header"),
        ("55 55 02 0F 55 55 08", [], "byte 4: it is no frame (too short"),
        (
            "13  # 0 s, either noise: bad header\n",
            [],
            "line 1: it is no frame (bad header: a frame begins 55 55); --skip-noise leaves out",
        ),
        (
            f"{hexed(ASK)}  # 0 s, host: a\n55 55 09 0F  # 1 s, host: b\n",
            [],
            "line 2: it is no frame (length mismatch: the length is 9",
        ),
        ("55 55 04 0F 4C 1D  # 0 s, host: a\n", [], "line 1: it is no frame (length mismatch"),
        ("55  # 0 s, host: a\n", [], "line 1: it is no frame (bad header"),
        ("5G 55  # 0 s, host: a\n", [], "line 1: no hex: 'G' in '5G' is no hex digit"),
        (f"{hexed(ASK)}  # 0 s, martian: a\n", [], "'martian' is none of those who send"),
        (f"{hexed(ASK)}  # 0 s, host: a\n{hexed(ASK)}\n", [], "line 2: it has no time and sender"),
        (
            f"{hexed(ASK)}  # 5 s, host: a\n{hexed(ASK)}  # 0.5 s, host: b\n",
            [],
            "line 2: 0.500000 s is before 5.000000 s in a line above",
        ),
        ("55 55 04 0F 4C 1D", [], "holds nothing to send; it holds 1 frame of controller"),
        ("", [], "holds nothing to send; it holds nothing at all"),
        ("zz", ["--format", "hex"], "line.hex, line 1: no hex: 'z' in 'zz'"),
        (hexed(ASK), ["--speed", "0"], "argument --speed: 0 is not above 0"),
        (hexed(ASK), ["--speed", "nan"], "argument --speed: 'nan' is no number"),
        (hexed(ASK), ["--speed", "fast"], "argument --speed: 'fast' is no number"),
        (hexed(ASK), ["--raw", "--skip-noise"], "not allowed with argument"),
    ],
)
def test_what_is_malformed_is_refused_before_anything_is_sent(
    log: Path, capsys: Capture, text: str, words: list[str], expected: str
) -> None:
    log.write_text(text)
    assert replayed(log, *words) == (2, [])
    errors = capsys.readouterr().err
    assert expected in errors
    assert "Traceback" not in errors


def test_a_missing_file_is_reported(tmp_path: Path, capsys: Capture) -> None:
    assert main(["replay", str(tmp_path / "none.hex"), "--dry-run"]) == 2
    assert "none.hex cannot be read: No such file or directory" in capsys.readouterr().err


def test_without_a_port_a_replay_is_only_shown(
    log: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(link, "serial_ports", list)
    log.write_text(hexed(ASK))
    assert main(["replay", str(log)]) == 2
    assert "no port is plugged in" in capsys.readouterr().err
    assert main(["replay", str(log), "--dry-run"]) == 0
