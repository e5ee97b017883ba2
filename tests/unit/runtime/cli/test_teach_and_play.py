"""`teach` and `play`: what they ask, what they keep, what they refuse, and what moves."""

from __future__ import annotations

import io
import itertools
import json
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import pytest
from busservo import ServoMove, ServoPositionsRead, ServoUnload
from busservo._cli import main
from busservo._cli.posefile import Recorded, read_poses, write_poses
from busservo._client.exchanges import POSE
from busservo_simulator import VirtualController
from hypothesis import given
from hypothesis import strategies as st

from tests.timeouts import GENEROUS, await_that

if TYPE_CHECKING:
    from collections.abc import Iterator

    from busservo import Message

Capture = pytest.CaptureFixture[str]

PATIENT = ("--timeout", str(GENEROUS), "--baud", "inf")


@pytest.fixture
def board() -> Iterator[VirtualController]:
    with VirtualController("tcp", servos=[1, 2, 3]) as board:
        yield board


@pytest.fixture
def received(board: VirtualController) -> list[Message]:
    """Return the messages that the board has understood, in order."""
    messages: list[Message] = []
    accepted = board.board.accepted

    def noted(message: Message) -> None:
        messages.append(message)
        accepted(message)

    board.board.accepted = noted  # type: ignore[method-assign]
    return messages


@pytest.fixture
def typed(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Let the next command read these keys."""
    return lambda keys: monkeypatch.setattr(sys, "stdin", io.StringIO(keys))


def poses_of(*poses: Any, **more: Any) -> str:
    whole = {"format": "busservo poses", "version": 1, "poses": list(poses), **more}
    return json.dumps(whole)


def kinds(messages: list[Message]) -> list[type[Message]]:
    return [type(each) for each in messages]


# ------------------------------------------------------------------ teach


def test_poses_are_recorded_at_each_enter_and_held_at_the_end(
    board: VirtualController, received: list[Message], typed: Any, tmp_path: Path, capsys: Capture
) -> None:
    file = tmp_path / "poses.json"
    typed("y\n\nwhat\n\nq\ny\n")
    assert main(["teach", str(file), "--port", board.port, *PATIENT]) == 0
    output, errors = capsys.readouterr()
    assert output == "pose 1  1:500,2:500,3:500\npose 2  1:500,2:500,3:500\n"
    assert "servos 1, 2, 3 will go limp, and what they hold up falls: support it." in errors
    assert "'what' is not an answer; press Enter, or q and Enter" in errors
    assert "2 poses recorded; servos 1, 2, 3 held\n" in errors
    # The last of them may be on its way yet.
    await_that(lambda: len(received) == 9)
    assert received[4] == ServoUnload([1, 2, 3])
    assert received[5:] == [
        *(2 * [ServoPositionsRead([1, 2, 3])]),
        ServoPositionsRead([1, 2, 3]),
        ServoMove(time_ms=100, targets=[(1, 500), (2, 500), (3, 500)]),
    ]
    assert file.read_text() == (
        '{\n  "format": "busservo poses",\n  "version": 1,\n  "poses": [\n'
        '    {"positions": {"1": 500, "2": 500, "3": 500}},\n'
        '    {"positions": {"1": 500, "2": 500, "3": 500}}\n  ]\n}\n'
    )
    assert list(tmp_path.iterdir()) == [file]


@pytest.mark.parametrize("keys", ["", "\n", "n\n", "q\n", "no\ny\n"])
def test_no_servo_is_released_without_consent(
    board: VirtualController,
    received: list[Message],
    typed: Any,
    keys: str,
    tmp_path: Path,
    capsys: Capture,
) -> None:
    typed(keys)
    words = ["teach", str(tmp_path / "new"), "--port", board.port, "--ids", "1"]
    assert main([*words, *PATIENT]) == 1
    assert received == []
    assert "nothing was switched off, and nothing recorded" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("keys", "expected"), [("\n", "are limp"), ("\nq\n", "are limp")])
def test_servos_stay_limp_unless_holding_is_confirmed(
    board: VirtualController, typed: Any, keys: str, expected: str, tmp_path: Path, capsys: Capture
) -> None:
    typed(keys)
    words = ["teach", str(tmp_path / "new"), "--port", board.port, "--yes", "--ids", "1-2"]
    assert main([*words, *PATIENT]) == 0
    assert f"1 pose recorded; servos 1, 2 {expected}" in capsys.readouterr().err
    assert [board.servos[each].loaded for each in (1, 2, 3)] == [False, False, True]


def test_the_hold_option_needs_no_confirmation(
    board: VirtualController, typed: Any, tmp_path: Path
) -> None:
    typed("\n")
    words = ["teach", str(tmp_path / "new"), "--port", board.port, "--yes", "--hold"]
    assert main([*words, "--ids", "2", *PATIENT]) == 0
    await_that(lambda: board.servos[2].loaded)


def test_a_silent_servo_costs_only_the_pose(
    board: VirtualController, received: list[Message], typed: Any, tmp_path: Path, capsys: Capture
) -> None:
    board.servos[2].off = True
    typed("\nq\ny\n")
    words = ["teach", str(tmp_path / "new"), "--port", board.port, "--yes", "--ids", "1,2,9"]
    assert main([*words, *PATIENT]) == 1
    errors = capsys.readouterr().err
    assert "nothing recorded: " in errors
    assert "are off or missing: servo_ids 2, 9" in errors
    assert "not held: " in errors
    assert ServoMove not in kinds(received)
    assert list(tmp_path.iterdir()) == []


def test_what_is_far_outside_the_limits_is_not_recorded_as_if_it_were_not(
    board: VirtualController, typed: Any, tmp_path: Path, capsys: Capture
) -> None:
    typed("\nq\ny\n")
    words = ["teach", str(tmp_path / "new"), "--port", board.port, "--yes", "--ids", "1"]
    assert main([*words, "--limits", "600..2500", *PATIENT]) == 1
    problem = (
        "positions[0].position: 500 is outside the limits 600..2500; "
        "--limits 0..1000 is for what is usual, --limits 500..2500 is for PWM servo boards, "
        "--limits none sends anything\n"
    )
    errors = capsys.readouterr().err
    assert f"nothing recorded: {problem}" in errors
    assert f"not held: {problem}" in errors
    assert list(tmp_path.iterdir()) == []


def test_without_any_servo_nothing_is_released(typed: Any, tmp_path: Path, capsys: Capture) -> None:
    typed("y\n")
    with VirtualController("tcp", servos=[]) as board:
        assert main(["teach", str(tmp_path / "new"), "--port", board.port, *PATIENT]) == 1
    assert capsys.readouterr().err == "no servo is there: is the supply of the servos on?\n"
    words = ["--timeout", "0.01", "--baud", "inf"]
    assert main(["teach", str(tmp_path / "new"), "--port", "loop://", *words]) == 1
    assert "no ServoPositions came within" in capsys.readouterr().err


def test_more_than_one_motion_moves_are_not_taught(
    typed: Any, tmp_path: Path, capsys: Capture
) -> None:
    with VirtualController("tcp") as board:
        words = ["teach", str(tmp_path / "new"), "--port", board.port, "--ids", "1-84"]
        assert main([*words, *PATIENT]) == 2
    assert "84 servos are too many: one motion moves up to 83" in capsys.readouterr().err


def test_an_existing_file_is_never_overwritten_without_consent(
    board: VirtualController, received: list[Message], typed: Any, tmp_path: Path, capsys: Capture
) -> None:
    file = tmp_path / "poses.json"
    file.write_text(poses_of({"positions": {"7": 100}, "time_ms": 50, "pause_s": 0.5}))
    before = file.read_text()
    words = ["teach", str(file), "--port", board.port, "--yes", "--ids", "1-3", *PATIENT]
    assert main(words) == 2
    assert "exists already; --append adds to its poses" in capsys.readouterr().err
    assert (received, file.read_text()) == ([], before)
    typed("q\nn\n")
    assert main([*words, "--force"]) == 1
    assert file.read_text() == before
    typed("\nq\nn\n")
    assert main([*words, "--append"]) == 0
    assert [each.positions for each in read_poses(file, POSE)] == [
        {7: 100},
        {1: 500, 2: 500, 3: 500},
    ]
    assert read_poses(file, POSE)[0] == Recorded({7: 100}, 50, 0.5)
    typed("\nq\nn\n")
    assert main([*words, "--force"]) == 0
    assert [each.positions for each in read_poses(file, POSE)] == [{1: 500, 2: 500, 3: 500}]


class Folder:
    """The standard input of a program that was given a folder."""

    def readline(self) -> str:
        raise IsADirectoryError(21, "Is a directory")


def test_where_nobody_can_answer_nothing_is_released(
    board: VirtualController,
    received: list[Message],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: Capture,
) -> None:
    monkeypatch.setattr(sys, "stdin", Folder())
    words = ["teach", str(tmp_path / "new"), "--port", board.port, "--ids", "1", *PATIENT]
    assert main(words) == 1
    assert "nothing was switched off" in capsys.readouterr().err
    assert received == []
    assert main([*words, "--yes"]) == 1
    assert "0 poses recorded; servo 1 is limp\n" in capsys.readouterr().err


def test_limp_servos_are_named_when_a_pose_cannot_be_written(
    board: VirtualController, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: Capture
) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    words = ["teach", str(folder / "new"), "--port", board.port, "--ids", "1", "--yes", *PATIENT]

    class Removed(io.StringIO):
        def readline(self, *_: Any) -> Any:
            folder.rmdir()
            return "\n"

    monkeypatch.setattr(sys, "stdin", Removed())
    assert main(words) == 2
    errors = capsys.readouterr().err
    assert "0 poses recorded; servo 1 is limp\n" in errors
    assert "new cannot be written: No such file or directory" in errors


def test_an_unwritable_file_is_reported_before_any_servo_is_released(
    tmp_path: Path, capsys: Capture
) -> None:
    assert main(["teach", str(tmp_path / "no" / "new"), "--port", "loop://"]) == 2
    assert "there is no folder" in capsys.readouterr().err


# ------------------------------------------------------------------ play


TWO = (
    {"positions": {"1": 600, "2": 400}, "time_ms": 20},
    {"positions": {"1": 500}, "pause_s": 0.01},
)


def test_poses_are_played_in_their_order(
    board: VirtualController, received: list[Message], tmp_path: Path, capsys: Capture
) -> None:
    file = tmp_path / "poses.json"
    file.write_text(poses_of(*TWO))
    words = ["--port", board.port, "--time-ms", "30", "--repeat", "2"]
    assert main(["play", str(file), *words]) == 0
    cycle = [
        ServoMove(time_ms=20, targets=[(1, 600), (2, 400)]),
        ServoMove(time_ms=30, targets=[(1, 500)]),
    ]
    # The last of them may be on its way yet.
    assert received[:3] == [*cycle, cycle[0]]
    output, errors = capsys.readouterr()
    times = [float(line.split()[0]) for line in output.splitlines()]
    assert [line.split()[1:3] for line in output.splitlines()] == 2 * [["pose", "1"], ["pose", "2"]]
    # Nothing is sent before the motion before it has had its time, and the pause after it.
    waits = [after - before for before, after in itertools.pairwise(times)]
    assert all(wait >= least for wait, least in zip(waits, [0.02, 0.04, 0.02], strict=True))
    assert errors == "4 of 4 poses played\n"


def test_what_would_be_played_is_shown_and_not_sent(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "poses.json"
    file.write_text(poses_of(*TWO))
    assert main(["play", str(file), "--dry-run", "--pause", "1"]) == 0
    output, errors = capsys.readouterr()
    assert output.splitlines() == [
        "    0.000000  pose 1  ServoMove time_ms=20 ms targets=1:600,2:400",
        "    1.033542  pose 2  ServoMove time_ms=1000 ms targets=1:500",
    ]
    assert errors == "2 poses in 2.054 s: nothing was sent\n"
    assert main(["play", str(file), "--dry-run", "--baud", "inf"]) == 0
    assert capsys.readouterr().err == "2 poses in 1.030 s: nothing was sent\n"


GOOD = {"positions": {"1": 500}}
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
        (
            "poses[1].positions.7: 1200 is outside the limits 0..1000; "
            "--limits 500..2500 is for PWM servo boards, --limits none sends anything"
        ),
    ),
    (
        poses_of({"positions": {"1": 65535}}),
        "poses[0].positions.1: 65535 is outside the limits 0..1000; --limits none sends anything",
    ),
    (poses_of({**GOOD, "time_ms": 65536}), "poses[0].time_ms: 65536 is outside 0..65535"),
    (poses_of({**GOOD, "time_ms": 1.5}), "poses[0].time_ms: 1.5 is not a whole number"),
    (poses_of({**GOOD, "pause_s": -1}), "poses[0].pause_s: -1 is no number of seconds from 0 to 3"),
    (poses_of({**GOOD, "pause_s": float("nan")}), "poses[0].pause_s: NaN is no number of seconds"),
    (poses_of({**GOOD, "pause_s": True}), "poses[0].pause_s: true is no number of seconds"),
    ('{"format": 1, "format": 2}', "the key 'format' appears twice in one object"),
    ('{"format": ' + 5000 * "9" + "}", ": "),
]


@pytest.mark.parametrize(("text", "expected"), REFUSED, ids=lambda each: each[-60:])
def test_a_file_is_looked_at_as_a_whole_before_the_port_is_opened(
    text: str, expected: str, tmp_path: Path, capsys: Capture
) -> None:
    file = tmp_path / "poses.json"
    file.write_text(text, encoding="utf-8")
    assert main(["play", str(file), "--port", "no-such-port"]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors.startswith(f"busservo: error: {file}")
    assert expected in errors
    assert len(errors) < 500


def test_an_unreadable_file_is_reported(tmp_path: Path, capsys: Capture) -> None:
    (tmp_path / "raw").write_bytes(b"\xff\x00")
    for name in ("missing", "raw", "."):
        assert main(["play", str(tmp_path / name), "--dry-run"]) == 2
        assert "cannot be read: " in capsys.readouterr().err


def test_positions_for_other_boards_are_played_where_limits_say_so(
    board: VirtualController, received: list[Message], tmp_path: Path
) -> None:
    file = tmp_path / "poses.json"
    file.write_text(poses_of({"positions": {"1": 2500}, "time_ms": 1}, {"positions": {"1": 500}}))
    words = ["play", str(file), "--port", board.port, "--time-ms", "1"]
    assert main([*words, "--limits", "500..2500"]) == 0
    assert received[0] == ServoMove(time_ms=1, targets=[(1, 2500)])


def test_send_refuses_what_is_outside_the_limits(
    board: VirtualController, received: list[Message], capsys: Capture
) -> None:
    words = ["send", "--port", board.port, "ServoMove", "time_ms=1", "targets=1:500,2:1500"]
    assert main(words) == 2
    assert capsys.readouterr().err == (
        "busservo: error: targets[1].position: 1500 is outside the limits 0..1000; "
        "--limits 500..2500 is for PWM servo boards, --limits none sends anything\n"
    )
    assert received == []
    for limits in ("500..2500", "none"):
        assert main([*words, "--limits", limits]) == 0


# ------------------------------------------------------------------ the file


recorded = st.builds(
    Recorded,
    st.dictionaries(st.integers(0, 255), st.integers(0, 65535), min_size=1, max_size=83),
    st.none() | st.integers(0, 65535),
    st.none() | st.floats(0, 3600),
)


@given(st.lists(recorded, max_size=5))
def test_a_written_file_is_read_back(poses: list[Recorded]) -> None:
    with TemporaryDirectory() as folder:
        file = Path(folder, "poses.json")
        write_poses(file, poses)
        assert read_poses(file, POSE) == poses
        assert len(file.read_text().splitlines()) == 6 + max(1, len(poses))


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    real, link = tmp_path / "real.json", tmp_path / "link.json"
    real.write_text("")
    link.symlink_to(real)
    write_poses(link, [Recorded({1: 5})])
    assert link.is_symlink()
    assert read_poses(real, POSE) == [Recorded({1: 5})]
