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
