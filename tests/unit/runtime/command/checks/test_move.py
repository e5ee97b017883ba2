"""The one check that moves something: a servo, a little, and back."""

import math

import pytest
from busservo.__main__ import main
from busservo._command import PROGRAM
from busservo._exchanges import POSE
from busservo_simulator import Faults, VirtualController, servo
from framewire.client.limits import Limits
from framewire.command import doctor
from framewire.command.checks import move
from framewire.command.checks.checks import examine
from framewire.command.checks.move import move_check
from framewire.command.checks.result import FAILED, PASSED, UNKNOWN, Result

from tests.lines.patient import CHECKS, board_with, diagnosis_of
from tests.timeouts import GENEROUS

OPENING = [check for check in CHECKS if check.id in {"port", "permission", "busy", "opening"}]


def moved(board: VirtualController, servo: int = 1) -> Result:
    assert POSE is not None
    checks = [*OPENING, move_check(servo, POSE)]
    found = {check.id: result for check, result in examine(diagnosis_of(board), checks)}
    return found["move"]


@pytest.mark.parametrize(("began", "reached"), [(500, 520), (0, 20), (990, 970), (1000, 980)])
def test_a_servo_goes_a_little_and_back(began: int, reached: int) -> None:
    with board_with() as board:
        board.servos[1].move(began, 0)
        board.advance(2)
        found = moved(board)
        assert board.servos[1].position == began
        assert not any(servo.travelling for servo in board.servos.values())
    report = f"servo 1 was at {began}, was sent to {reached}, and was then at {reached}"
    assert found == (PASSED, f"{report}; sent back, it is at {began}", (), "", "")


def test_it_moves_even_where_replies_are_lost() -> None:
    with board_with(Faults(dropped=0.3, seed=2)) as board:
        assert moved(board).state == PASSED


def test_a_missing_servo_is_not_moved() -> None:
    with board_with() as board:
        found = moved(board, 9)
        assert board.accepted == 1
        assert (found.state, found.advice) == (FAILED, "see the check `present`")
        board.servos[2].off = True
        assert "reports no position, so it was not moved" in moved(board, 2).seen
        assert board.accepted == 2


def test_what_is_outside_the_limits_is_not_moved(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(PROGRAM.library, "limits", Limits((0, 400)))
    with board_with() as board:
        found = moved(board)
        assert board.accepted == 1
    assert found.state == UNKNOWN
    assert found.seen == "servo 1 is at 500, outside 0..400, so it was not moved"


def test_a_servo_that_does_not_move_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    with board_with() as board:
        monkeypatch.setattr(board.servos[1], "move", lambda *_: None)
        found = moved(board)
    assert found.state == FAILED
    assert found.seen == "servo 1 was at 500, was sent to 520, and was then at 500"
    assert "supply" in found.advice


@pytest.mark.parametrize(("answer", "status"), [("y\n", 0), ("n\n", 2), ("\n", 2), ("", 2)])
@pytest.mark.usefixtures("nothing_else_comes")
def test_it_asks_before_it_moves(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, answer: str, status: int
) -> None:
    class Terminal:
        def isatty(self) -> bool:
            return True

        def readline(self) -> str:
            return answer

    monkeypatch.setattr("sys.stdin", Terminal())
    monkeypatch.setattr(doctor, "checks_of", lambda _: OPENING)
    # It moves in no time, and so before its position is read, on however slow a machine.
    monkeypatch.setattr(servo, "STEPS_PER_SECOND", math.inf)
    monkeypatch.setattr(move, "_MILLISECONDS", 0)
    monkeypatch.setattr(move, "_AFTER", 0.0)
    words = ["--move", "1", "--timeout", str(GENEROUS)]
    with VirtualController("tcp") as board:
        assert main(["doctor", "--port", board.port, *words]) == status
        assert board.servos[1].position == 500
    output, errors = capsys.readouterr()
    question = "servo 1 will move by 20 steps and back; keep clear of it. Go on? [y/N] "
    assert errors.startswith(question)
    assert ("passed   move " in output) == (status == 0)
    assert ("nothing was moved" in errors) == (status == 2)
