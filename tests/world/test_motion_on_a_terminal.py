"""`teach`, `play` and `move` on a terminal: however they end, nothing is lost or goes on moving."""

import re
import sys
from pathlib import Path

import pytest
from busservo._exchanges import POSE
from busservo_simulator import VirtualController
from framewire.command.posefile import read_poses

if sys.platform != "linux":
    pytest.skip("terminals differ by system, and only Linux's are tried", allow_module_level=True)

from tests.lines.boards import no_board_refuses_anything
from tests.lines.terminal import OnTerminal
from tests.timeouts import await_that
from tests.unit.runtime.command.conftest import board
from tests.unit.runtime.command.test_teach_and_play import PATIENT, poses_of

__all__ = ["board", "no_board_refuses_anything"]

# One that comes just before a program reads is seen when it has read.
CTRL_C, CTRL_D = b"\x03\n", b"\x04"


@pytest.mark.parametrize(
    ("key", "status"), [(CTRL_C, 130), (CTRL_D, 0), (b"q\nn\n", 0), (b"Q\nyes\n", 0)]
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
        play.type(CTRL_C[:1])
        assert play.end() == 130
    assert "servos 1, 2 held" in play.shown
    assert "0 of 1 pose played" in play.shown
    assert not board.servos[1].travelling or board.servos[1].target < 600


def test_ctrl_c_holds_what_a_move_moves(board: VirtualController) -> None:
    words = ("1:1000", "2:0", "--in", "60s", "--port", board.port, *PATIENT)
    with OnTerminal("move", *words) as move:
        await_that(lambda: board.servos[1].travelling)
        move.type(b"\x03")
        assert move.end() == 130
    assert re.search("servos 1, 2 held", move.shown)
    assert not board.servos[1].travelling or board.servos[1].target < 600
