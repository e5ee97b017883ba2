"""Lines of other kinds, in virtual time: faster than stated, with an echo, or busy before."""

import math
from typing import Any

from tests.contract.independent import faults
from tests.contract.independent.board import Board
from tests.contract.independent.conversation import (
    BAUD,
    REPLY_TIMEOUT,
    SIX,
    Conversation,
    question_of,
    seconds,
    talking,
    wire_time,
)
from tests.contract.independent.ports import VirtualPort
from tests.in_turn import in_turn


def conversation(board: Board, reads: int, **given: Any) -> tuple[Conversation, Any]:
    """Read the battery so often, one after the other; return the calls and what was counted."""
    with talking(board, **given) as (talk, controller):
        for _ in range(reads):
            talk.ask(controller, None)
    return talk, controller.counters


def times(talk: Conversation) -> list[float]:
    """Return how long each call took."""
    return [each.ended - each.began for each in talk.calls]


# ------------------------------------------------------------------- faster than stated
def test_a_line_is_learnt_to_be_faster_from_three_replies_that_were_impossible() -> None:
    """Each of these is held until the line has been quiet; from then on, none is."""
    talk, counters = conversation(Board(), 10)
    assert (talk.stale, talk.failed) == ([], [])
    assert counters.impossible == 3
    assert max(times(talk)[3:]) < 0.001
    assert max(times(talk)) < REPLY_TIMEOUT + 2 * wire_time(None, BAUD)
    # One that is said to be faster is believed.
    talk, counters = conversation(Board(), 10, baud=math.inf)
    assert (talk.stale, talk.failed) == ([], [])
    assert counters.impossible == 0
    assert max(times(talk)) < 0.001


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


# ------------------------------------------------------------------- a process that pauses
class Pausing(VirtualPort):
    """A process that stands still for a second behind a read that gave so many bytes in all."""

    def __init__(self, board: Board, behind: int) -> None:
        super().__init__(board)
        self._left = behind

    def read(self, timeout: float) -> bytes:
        data = super().read(timeout)
        if 0 < self._left <= len(data):
            self.now += 1.0
        self._left -= len(data)
        return data


@in_turn("behind", lambda: range(1, 24))
def test_a_process_that_stands_still_within_a_healthy_reply_loses_nothing(behind: int) -> None:
    with talking(Pausing(Board(baud=BAUD), behind), settle=None) as (_, controller):
        for number in (1, 2, 3):
            positions = controller.read_servo_positions(SIX)
            assert {position for _, position in positions} == {number}
        assert controller.counters.noise == 0


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
