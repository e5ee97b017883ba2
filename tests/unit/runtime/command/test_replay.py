"""The verb `replay`: what it sends, what it leaves out, and what it refuses before it sends."""

import re
import socket
import time
from pathlib import Path
from unittest import mock

import busservo
import pytest
from busservo import ActionGroupRun, Message, Noise, ServoMove, ServoPositionsRead, ServoUnload
from busservo_simulator import Faults, VirtualController
from framewire.command import link, playback
from framewire.command.playback import Playback

from tests.commands import Ended, run
from tests.in_turn import in_turn
from tests.timeouts import GENEROUS, await_that

MOVE = ServoMove(time_ms=100, targets=[(1, 600)])
ASK = busservo.BatteryVoltageRead()
READ = ServoPositionsRead([1])
RUN = ActionGroupRun(group=8, times=1)
HEX = "55 55 02 0F"
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


def at(seconds: float, message: Message, sender: str = "host") -> str:
    """Return a line of a recording."""
    return f"{message.encode().hex(' ')}  # {seconds} s, {sender}: it\n"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    return tmp_path / "line.hex"


def replayed(log: Path, *words: str) -> tuple[Ended, list[Message | Noise]]:
    """Replay, and return how that ended, and the messages that a board received."""
    received: list[Message | Noise] = []
    with (
        VirtualController("tcp") as board,
        mock.patch.object(board.board, "accepted", received.append),
        mock.patch.object(board.board, "rejected", received.append),
    ):
        ended = run("replay", log, "--port", board.port, *words)
        # The next client is let in once all has been received that was sent before.
        address = ("127.0.0.1", int(board.port.rpartition(":")[2]))
        with socket.create_connection(address, GENEROUS) as caller:
            caller.sendall(LAST.encode())
            await_that(lambda: LAST in received)
    assert received.pop() == LAST
    return ended, received


def sent_by(log: Path, *words: str) -> list[Message | Noise]:
    """Return what a replay sends that ends well."""
    ended, received = replayed(log, *words)
    assert ended.status == 0
    return received


def test_a_trace_is_played_without_what_came_back(
    log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Before each of the three, and behind them for both answers.
    prolong_waits(monkeypatch, 0, 0, 0, 5)
    with (
        VirtualController("tcp") as board,
        busservo.open_controller(board.port, reply_timeout=GENEROUS, trace=log) as controller,
    ):
        controller.move_servos([(1, 600)], time_ms=100)
        board.send_bytes(b"\x13")
        controller.read_battery_voltage()
        controller.read_servo_positions([1])
    (status, output, errors), received = replayed(log)
    assert (status, received) == (0, [MOVE, ASK, READ])
    assert "host        BatteryVoltageRead | 55 55 02 0F\n" in output
    assert re.search(r"  controller  BatteryVoltage voltage_mv=.* \| 55 55 04 0F", output)
    first, totals = errors.splitlines()
    assert first == "left out: 2 frames of controller, 1 piece of noise"
    assert totals.startswith("3 of 3 frames sent, 20 bytes; came back: 14 bytes: 2 messages")


def test_a_lost_line_ends_the_replay_and_the_progress_is_reported(log: Path) -> None:
    log.write_text(at(0, ASK) + at(9, ASK))
    with VirtualController("tcp", faults=Faults(hang_up=1.0)) as board:
        status, _, errors = run("replay", log, "--port", board.port)
    totals, error = errors.splitlines()
    assert totals.startswith("1 of 2 frames sent, 4 bytes; came back: ")
    assert (status, "the line was lost" in error) == (3, True)


def test_half_a_frame_that_comes_back_is_given_up_when_the_line_is_quiet(
    log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The second is sent once the half frame has been shown, and its answer is waited for.
    prolong_waits(monkeypatch, 0, 2, 4)
    log.write_text(at(0, MOVE) + at(0.1, ASK))
    with VirtualController("tcp") as board:

        def begin(_: ServoMove) -> None:
            board.send_bytes(bytes.fromhex("55 55 04"))

        with mock.patch.object(board.board, "on_servo_move", begin):
            status, output, _ = run("replay", log, "--port", board.port)
    said = [line[14:].partition(" ")[0] for line in output.splitlines()]
    assert (status, said) == (0, ["host", "noise", "host", "controller"])


@in_turn(
    "words, times",
    lambda: [
        ([], ["0.000000", "0.500000", "0.504167"]),
        (["--speed", "2"], ["0.000000", "0.250000", "0.254167"]),
        (["--speed", "0.5"], ["0.000000", "1.000000", "1.004167"]),
        # As fast as the line can: ten bytes of ten bits at 9600 baud, then four.
        (["--speed", "inf"], ["0.000000", "0.010417", "0.014583"]),
    ],
)
def test_a_replay_keeps_the_recorded_pace_or_that_of_the_line(
    log: Path, words: list[str], times: list[str]
) -> None:
    # The last two at once, which no line can carry.
    log.write_text(at(3.5, MOVE) + at(4.0, ASK) + at(4.0, READ))
    status, output, errors = run("replay", log, "--dry-run", *words)
    assert [line.split()[0] for line in output.splitlines()] == times
    seconds = float(times[-1]) + 6 * 10 / 9600
    said = f"3 frames, 20 bytes in {seconds:.3f} s: nothing was sent\n"
    assert (status, errors) == (0, said)


EITHER = at(0.1, RUN, "either")
TWO = RUN.encode().hex() + ASK.encode().hex()


@in_turn(
    "text, words, received",
    lambda: [
        (EITHER + at(1, ASK), ["--either", "send"], [RUN, ASK]),
        (EITHER + at(1, ASK), ["--either", "skip"], [ASK]),
        (TWO, ["--either", "skip"], [ASK]),
        (TWO, ["--direction", "host"], [RUN, ASK]),
        ("13 55 55 02 0F", ["--skip-noise"], [ASK]),
        (f"13  # 0 s, host noise: bad header\n{at(1, ASK)}", ["--skip-noise"], [ASK]),
        # It was no frame when it was received, and so it is none now.
        (at(0, MOVE, "host noise") + at(1, ASK), ["--skip-noise"], [ASK]),
        ("55 55 02 0F 55 55 02 0F 55 55 04 0F 4C 1D", [], [ASK, ASK]),
    ],
)
def test_ambiguous_frames_are_sent_on_request(
    log: Path, text: str, words: list[str], received: list[Message]
) -> None:
    log.write_text(text)
    assert sent_by(log, "--speed", "inf", *words) == received


@pytest.mark.garbage
def test_raw_sends_every_byte_whoever_sent_it(log: Path) -> None:
    unload = at(1, ServoUnload([1]), "controller")
    log.write_text(f"13  # 0 s, noise: bad header\n{EITHER}{unload}")
    received = sent_by(log, "--raw", "--speed", "inf")
    assert [type(event) for event in received] == [Noise, ActionGroupRun, ServoUnload]


OPEN = "it is ActionGroupRun or ActionGroupStarted"
NO_FRAME = "it is no frame"
BEGINS = "bad header: a frame begins 55 55"


@in_turn(
    "text, words, expected",
    lambda: [
        (EITHER, [], f"line 1: {OPEN} group=8 times=1, and not"),
        (RUN.encode().hex(), [], f"byte 0: {OPEN}"),
        ("5555020F 13", [], f"byte 4: {NO_FRAME} (bad header"),
        ("55 55 02 0F 55 55 08", [], f"byte 4: {NO_FRAME} (too short"),
        (
            "13  # 0 s, either noise: bad header\n",
            [],
            f"line 1: {NO_FRAME} ({BEGINS}); --skip-noise leaves out",
        ),
        (
            f"{at(0, ASK)}55 55 09 0F  # 1 s, host: b\n",
            [],
            f"line 2: {NO_FRAME} (length mismatch: the length is 9",
        ),
        ("55 55 04 0F 4C 1D  # 0 s, host: a\n", [], f"line 1: {NO_FRAME} (length mismatch"),
        ("55  # 0 s, host: a\n", [], f"line 1: {NO_FRAME} (bad header"),
        ("5G 55  # 0 s, host: a\n", [], "line 1: no hex: 'G' in '5G' is no hex digit"),
        (at(0, ASK, "martian"), [], "'martian' is none of those who send"),
        (f"{at(0, ASK)}55 55 02 0F\n", [], "line 2: it has no time and sender"),
        (at(5, ASK) + at(0.5, ASK), [], "line 2: 0.500000 s is before 5.000000 s in a line above"),
        ("55 55 04 0F 4C 1D", [], "holds nothing to send; it holds 1 frame of controller"),
        ("", [], "holds nothing to send; it holds nothing at all"),
        ("zz", ["--format", "hex"], "line.hex, line 1: no hex: 'z' in 'zz'"),
        (HEX, ["--speed", "0"], "argument --speed: 0 is not above 0"),
        (HEX, ["--speed", "nan"], "argument --speed: 'nan' is no number"),
        (HEX, ["--speed", "fast"], "argument --speed: 'fast' is no number"),
        (HEX, ["--raw", "--skip-noise"], "not allowed with argument"),
    ],
)
def test_what_is_malformed_is_refused_before_anything_is_sent(
    log: Path, text: str, words: list[str], expected: str
) -> None:
    log.write_text(text)
    ended, received = replayed(log, *words)
    assert (ended.status, received) == (2, [])
    assert expected in ended.err
    assert "Traceback" not in ended.err


def test_without_a_port_a_replay_is_only_shown(log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(link, "serial_ports", list)
    log.write_text(HEX)
    status, _, errors = run("replay", log)
    assert (status, "no port is plugged in" in errors) == (2, True)
    assert run("replay", log, "--dry-run").status == 0
