"""`teach` and `play`: what they ask, what they keep, what they refuse, and what moves."""

import io
import itertools
import json
import sys
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from busservo import Message, ServoMove, ServoPositionsRead, ServoUnload
from busservo.__main__ import main
from busservo._exchanges import POSE
from busservo_simulator import VirtualController
from framewire.command.posefile import Recorded, read_poses, write_poses
from hypothesis import strategies as st

from tests.commands import Ended, run
from tests.in_turn import in_turn
from tests.lines.at_board import received_by
from tests.timeouts import GENEROUS, await_that

PATIENT = ("--timeout", str(GENEROUS), "--baud", "inf")


class Desk(NamedTuple):
    """A board, what it has understood, and the file of poses beside it."""

    board: VirtualController
    received: list[Message]
    file: Path

    def teach(self, *words: str, keys: str = "") -> Ended:
        """Record poses, with these keys."""
        return run("teach", self.file, "--port", self.board.port, *PATIENT, *words, given=keys)

    def play(self, *words: str) -> Ended:
        """Play what was recorded."""
        return run("play", self.file, "--port", self.board.port, *words)

    @property
    def poses(self) -> list[dict[int, int]]:
        """The positions in the file."""
        return [each.positions for each in read_poses(self.file, POSE, "busservo")]


@pytest.fixture
def desk(board: VirtualController, tmp_path: Path) -> Desk:
    return Desk(board, received_by(board), tmp_path / "poses.json")


def poses_of(*poses: Any, **more: Any) -> str:
    return json.dumps({"format": "busservo poses", "version": 1, "poses": list(poses), **more})


# ------------------------------------------------------------------ teach
def test_poses_are_recorded_at_each_enter_and_held_at_the_end(desk: Desk) -> None:
    status, output, errors = desk.teach(keys="y\n\nwhat\n\nq\ny\n")
    assert (status, output) == (0, "pose 1  1:500,2:500,3:500\npose 2  1:500,2:500,3:500\n")
    assert "servos 1, 2, 3 will go limp, and what they hold up falls: support it." in errors
    assert "'what' is not an answer; press Enter, or q and Enter" in errors
    assert "2 poses recorded; servos 1, 2, 3 held\n" in errors
    # The last of them may be on its way yet.
    await_that(lambda: len(desk.received) == 9)
    assert desk.received[4:] == [
        ServoUnload([1, 2, 3]),
        *(3 * [ServoPositionsRead([1, 2, 3])]),
        ServoMove(time_ms=100, targets=[(1, 500), (2, 500), (3, 500)]),
    ]
    assert desk.file.read_text() == (
        '{\n  "format": "busservo poses",\n  "version": 1,\n  "poses": [\n'
        '    {"positions": {"1": 500, "2": 500, "3": 500}},\n'
        '    {"positions": {"1": 500, "2": 500, "3": 500}}\n  ]\n}\n'
    )
    assert list(desk.file.parent.iterdir()) == [desk.file]


@in_turn("keys", lambda: ["", "\n", "n\n", "q\n", "no\ny\n"])
def test_no_servo_is_released_without_consent(desk: Desk, keys: str) -> None:
    status, _, errors = desk.teach("--ids", "1", keys=keys)
    assert (status, desk.received) == (1, [])
    assert "nothing was switched off, and nothing recorded" in errors
    assert not desk.file.exists()


@pytest.mark.parametrize("keys", ["\n", "\nq\n"])
def test_servos_stay_limp_unless_holding_is_confirmed_or_asked_for(desk: Desk, keys: str) -> None:
    status, _, errors = desk.teach("--yes", "--ids", "1-2", keys=keys)
    assert status == 0
    assert "1 pose recorded; servos 1, 2 are limp" in errors
    assert [desk.board.servos[each].loaded for each in (1, 2, 3)] == [False, False, True]
    assert desk.teach("--yes", "--hold", "--force", "--ids", "2", keys="\n").status == 0
    await_that(lambda: desk.board.servos[2].loaded)


def test_what_is_far_outside_the_limits_is_not_recorded_as_if_it_were_not(desk: Desk) -> None:
    words = ("--yes", "--ids", "1", "--limits", "600..2500")
    status, _, errors = desk.teach(*words, keys="\nq\ny\n")
    usual = "is outside the limits 600..2500; --limits 0..1000 is for what is usual, --limits"
    problem = f"positions[0].position: 500 {usual} {PWM} {ANY}\n"
    assert status == 1
    assert f"nothing recorded: {problem}" in errors
    assert f"not held: {problem}" in errors
    assert not desk.file.exists()


def test_without_any_servo_nothing_is_released(tmp_path: Path) -> None:
    words = ("teach", tmp_path / "new", "--baud", "inf", "--port")
    with VirtualController("tcp", servos=[]) as board:
        done = run(*words, board.port, "--timeout", GENEROUS, given="y\n")
    assert done == (1, "", "no servo is there: is the supply of the servos on?\n")
    status, _, errors = run(*words, "loop://", "--timeout", "0.01")
    assert (status, "no ServoPositions came within" in errors) == (1, True)


def test_what_cannot_be_taught_is_refused_before_any_servo_is_released(desk: Desk) -> None:
    status, _, errors = desk.teach("--ids", "1-84")
    assert (status, desk.received) == (2, [])
    assert "84 servos are too many: one motion moves up to 83" in errors
    status, _, errors = desk._replace(file=desk.file / "no" / "new").teach()
    assert (status, desk.received) == (2, [])
    assert "there is no folder" in errors


def test_an_existing_file_is_never_overwritten_without_consent(desk: Desk) -> None:
    before = poses_of({"positions": {"7": 100}, "time_ms": 50, "pause_s": 0.5})
    desk.file.write_text(before)
    words = ("--yes", "--ids", "1-3")
    status, _, errors = desk.teach(*words)
    assert status == 2
    assert "exists already; --append adds to its poses" in errors
    assert (desk.received, desk.file.read_text()) == ([], before)
    assert desk.teach(*words, "--force", keys="q\nn\n").status == 1
    assert desk.file.read_text() == before
    assert desk.teach(*words, "--append", keys="\nq\nn\n").status == 0
    assert desk.poses == [{7: 100}, {1: 500, 2: 500, 3: 500}]
    assert read_poses(desk.file, POSE, "busservo")[0] == Recorded({7: 100}, 50, 0.5)
    assert desk.teach(*words, "--force", keys="\nq\nn\n").status == 0
    assert desk.poses == [{1: 500, 2: 500, 3: 500}]


class Folder:
    """The standard input of a program that was given a folder."""

    def readline(self) -> str:
        raise IsADirectoryError(21, "Is a directory")


def test_where_nobody_can_answer_nothing_is_released(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "stdin", Folder())
    words = ["teach", str(desk.file), "--port", desk.board.port, "--ids", "1", *PATIENT]
    assert main(words) == 1
    assert "nothing was switched off" in capsys.readouterr().err
    assert desk.received == []
    assert main([*words, "--yes"]) == 1
    assert "0 poses recorded; servo 1 is limp\n" in capsys.readouterr().err


def test_limp_servos_are_named_when_a_pose_cannot_be_written(
    desk: Desk, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = desk.file.parent / "folder"
    folder.mkdir()

    class Removed(io.StringIO):
        def readline(self, *_: Any) -> Any:
            folder.rmdir()
            return "\n"

    monkeypatch.setattr(sys, "stdin", Removed())
    words = ["--port", desk.board.port, "--ids", "1", "--yes", *PATIENT]
    assert main(["teach", str(folder / "new"), *words]) == 2
    errors = capsys.readouterr().err
    assert "0 poses recorded; servo 1 is limp\n" in errors
    assert "new cannot be written: No such file or directory" in errors


# ------------------------------------------------------------------ play
TWO = (
    {"positions": {"1": 600, "2": 400}, "time_ms": 20},
    {"positions": {"1": 500}, "pause_s": 0.01},
)


def test_poses_are_played_in_their_order(desk: Desk) -> None:
    desk.file.write_text(poses_of(*TWO))
    status, output, errors = desk.play("--time-ms", "30", "--repeat", "2")
    cycle = [
        ServoMove(time_ms=20, targets=[(1, 600), (2, 400)]),
        ServoMove(time_ms=30, targets=[(1, 500)]),
    ]
    # The last of them may be on its way yet.
    assert desk.received[:3] == [*cycle, cycle[0]]
    times = [float(line.split()[0]) for line in output.splitlines()]
    assert [line.split()[1:3] for line in output.splitlines()] == 2 * [["pose", "1"], ["pose", "2"]]
    # Nothing is sent before the motion before it has had its time, and the pause after it.
    waits = [after - before for before, after in itertools.pairwise(times)]
    assert all(wait >= least for wait, least in zip(waits, [0.02, 0.04, 0.02], strict=True))
    assert (status, errors) == (0, "4 of 4 poses played\n")


def test_what_would_be_played_is_shown_and_not_sent(desk: Desk) -> None:
    desk.file.write_text(poses_of(*TWO))
    status, output, errors = run("play", desk.file, "--dry-run", "--pause", "1")
    assert output.splitlines() == [
        "    0.000000  pose 1  ServoMove time_ms=20 ms targets=1:600,2:400",
        "    1.033542  pose 2  ServoMove time_ms=1000 ms targets=1:500",
    ]
    assert (status, errors) == (0, "2 poses in 2.054 s: nothing was sent\n")
    assert desk.play("--dry-run", "--baud", "inf").err == "2 poses in 1.030 s: nothing was sent\n"
    assert desk.received == []


GOOD = {"positions": {"1": 500}}
LIMITS = "is outside the limits 0..1000; --limits"
PWM = "500..2500 is for PWM servo boards, --limits"
ANY = "none sends anything"
SECONDS = "is no number of seconds"
# What a file holds, and what is said of it.
REFUSED: list[tuple[str, str]] = [
    ("", "line 1, column 1: it is not JSON: Expecting value"),
    ("{\n  'format': 1}", "line 2, column 3: it is not JSON"),
    (100_000 * "[", ": "),
    ("[]", ": [] is not an object {...}"),
    ("{}", ": the key 'format' is missing"),
    (poses_of(format="poses"), "format: \"poses\" is not 'busservo poses'"),
    (poses_of(version=2), "version: 2 is not a version known here, which is 1"),
    (poses_of(version=True), "version: true is not a version"),
    (poses_of(poses=5), "poses: 5 is not a list"),
    (poses_of(speed=5), "there is no key 'speed'; there are format, version, poses"),
    (poses_of(), " holds no pose"),
    (poses_of(GOOD, []), "poses[1]: [] is not an object {...}"),
    (poses_of(GOOD, {}), "poses[1]: the key 'positions' is missing"),
    (poses_of({**GOOD, "tiem_ms": 5}), "poses[0]: there is no key 'tiem_ms'; did you mean 'time_"),
    (poses_of({"positions": []}), "poses[0].positions: [] is not an object {...}"),
    (poses_of({"positions": {}}), "poses[0].positions: 0 servos is outside 1..83, which one"),
    (poses_of({"positions": dict.fromkeys(map(str, range(84)), 1)}), "84 servos is outside 1..83"),
    (poses_of({"positions": {"one": 5}}), "poses[0].positions: 'one' is not the number of a servo"),
    (poses_of({"positions": {"01": 5}}), "'01' is not the number of a servo"),
    (poses_of({"positions": {"\u0661": 5}}), "is not the number of a servo"),
    (poses_of({"positions": {"256": 5}}), "poses[0].positions.256: 256 is outside 0..255"),
    (poses_of({"positions": {"9" * 5000: 5}}), "is not the number of a servo"),
    (poses_of({"positions": {"1": "5"}}), "positions.1: '5' is not a whole number, but a str"),
    (poses_of({"positions": {"1": True}}), "positions.1: True is a truth value"),
    (poses_of({"positions": {"1": 500.0}}), "positions.1: 500.0 is not a whole number"),
    (poses_of({"positions": {"1": None}}), "positions.1: None is not a whole number"),
    (poses_of({"positions": {"1": 65536}}), "positions.1: 65536 is outside 0..65535"),
    (
        poses_of(GOOD, {"positions": {"1": 500, "7": 1200}}),
        f"poses[1].positions.7: 1200 {LIMITS} {PWM} {ANY}",
    ),
    (poses_of({"positions": {"1": 65535}}), f"poses[0].positions.1: 65535 {LIMITS} {ANY}"),
    (poses_of({**GOOD, "time_ms": 65536}), "poses[0].time_ms: 65536 is outside 0..65535"),
    (poses_of({**GOOD, "time_ms": 1.5}), "poses[0].time_ms: 1.5 is not a whole number"),
    (poses_of({**GOOD, "pause_s": -1}), f"poses[0].pause_s: -1 {SECONDS} from 0 to 3"),
    (poses_of({**GOOD, "pause_s": float("nan")}), f"poses[0].pause_s: NaN {SECONDS}"),
    (poses_of({**GOOD, "pause_s": True}), f"poses[0].pause_s: true {SECONDS}"),
    ('{"format": 1, "format": 2}', "the key 'format' appears twice in one object"),
    ('{"format": ' + 5000 * "9" + "}", ": "),
]


@in_turn("text, expected", lambda: REFUSED, ids=lambda row: repr(row[1]))
def test_a_file_is_looked_at_as_a_whole_before_the_port_is_opened(
    text: str, expected: str, tmp_path: Path
) -> None:
    file = tmp_path / "poses.json"
    file.write_text(text, encoding="utf-8")
    status, output, errors = run("play", file, "--port", "no-such-port")
    assert (status, output) == (2, "")
    assert errors.startswith(f"busservo: error: {file}")
    assert expected in errors
    assert len(errors) < 500


@in_turn("name", lambda: ["missing", "raw", "."])
def test_an_unreadable_file_is_reported(tmp_path: Path, name: str) -> None:
    (tmp_path / "raw").write_bytes(b"\xff\x00")
    status, _, errors = run("play", tmp_path / name, "--dry-run")
    assert (status, "cannot be read: " in errors) == (2, True)


def test_positions_for_other_boards_are_played_where_limits_say_so(desk: Desk) -> None:
    desk.file.write_text(poses_of({"positions": {"1": 2500}, "time_ms": 1}, GOOD))
    for limits in ("500..2500", "none"):
        assert desk.play("--time-ms", "1", "--limits", limits).status == 0
    assert desk.received[0] == ServoMove(time_ms=1, targets=[(1, 2500)])


# ------------------------------------------------------------------ the file
recorded = st.builds(
    Recorded,
    st.dictionaries(st.integers(0, 255), st.integers(0, 65535), min_size=1, max_size=83),
    st.none() | st.integers(0, 65535),
    st.none() | st.floats(0, 3600),
)


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    real, link = tmp_path / "real.json", tmp_path / "link.json"
    real.write_text("")
    link.symlink_to(real)
    write_poses(link, [Recorded({1: 5})], "busservo")
    assert link.is_symlink()
    assert read_poses(real, POSE, "busservo") == [Recorded({1: 5})]
