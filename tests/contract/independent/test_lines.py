"""Lines of other kinds, in virtual time: faster than stated, with an echo, or busy before."""

import math
from typing import Any

from tests.contract.independent import faults
from tests.contract.independent.board import Board
from tests.contract.independent.conversation import (
    BAUD,
    SIX,
    Conversation,
    question_of,
    seconds,
    talking,
)
from tests.contract.independent.firmware import COMPLETED, STARTED, STOPPED, report
from tests.in_turn import in_turn


def conversation(board: Board, reads: int, **given: Any) -> tuple[Conversation, Any]:
    """Read the battery so often, one after the other; return the calls and what was counted."""
    with talking(board, **given) as (talk, controller):
        for _ in range(reads):
            talk.ask(controller, None)
    return talk, controller.counters


# ------------------------------------------------------------------- faster than stated
@in_turn("baud", lambda: [BAUD, math.inf])
def test_stale_replies_on_a_fast_line_end_with_the_first_pause(baud: float) -> None:
    """A line that is fast, be that learnt or said, and a reply that comes again while the board
    thinks about the next question: without a pause, each read gets the answer to the one
    before, and nobody can know.
    """
    board = Board(thinks=0.002, faults={6: faults.duplicated(0.001)}.get)
    with talking(board, baud=baud) as (talk, controller):
        for _ in range(12):
            talk.ask(controller, None)
        assert [talk.calls.index(each) for each in talk.stale] == [6, 7, 8, 9, 10, 11]
        assert list(controller.reports(timeout=0.1)) == []
        assert controller.counters.unsolicited == 1
        for _ in range(8):
            talk.ask(controller, None)
        assert len(talk.stale) == 6
        assert talk.failed == []


def test_an_echo_that_is_said_to_be_there_is_dropped() -> None:
    board = Board(baud=BAUD, echo=True, thinks=0.001, unknown_groups=[9], group_seconds=0.1)
    with talking(board, local_echo=True, settle=None) as (_, controller):

        def reports() -> list[bytes]:
            return [each.encode() for each in controller.reports(timeout=0.3)]

        controller.stop_action_group()
        controller.run_action_group(9, times=1)
        assert reports() == []
        assert [controller.read_battery_voltage() for _ in range(3)] == [1, 2, 3]
        assert {position for _, position in controller.read_servo_positions(SIX)} == {4}
        controller.move_servos([(1, 500)], time_ms=1000)
        controller.run_action_group(8, times=1)
        assert reports() == [report(STARTED, 8, 1), report(COMPLETED, 8, 1)]
        controller.run_action_group(8, times=0)
        assert reports() == [report(STARTED, 8, 0)]
        controller.stop_action_group()
        assert reports() == [report(STOPPED)]
        assert controller.counters.noise == 0
    assert board.refused == []


# ------------------------------------------------------------------- a stranger's reply


# Its question was still on the wire, or its reply, when we opened the port; or all was over.
@in_turn("after", lambda: [-1.0, 0.0, 0.001, 0.004, 0.010, 0.015])
@in_turn("requested", lambda: [None, SIX])
def test_a_reply_meant_for_a_program_that_was_killed_is_not_taken_for_ours(
    after: float, requested: tuple[int, ...] | None
) -> None:
    board = Board(baud=BAUD)
    question = question_of(requested)
    board.write(question, after - seconds(question, BAUD))
    with talking(board, settle=None) as (talk, controller):
        for _ in range(3):
            talk.ask(controller, requested)
    assert (talk.stale, talk.failed) == ([], [])
