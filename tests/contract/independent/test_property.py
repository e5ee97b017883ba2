"""Any calls, with any faults of the replies: in virtual time, at 9600 baud.

A right reply or a declared error, in bounded time; no value from an impossible reply; no report
invented, and none lost; after any fault the second next read is right.
"""

from typing import NamedTuple

from hypothesis import example, given
from hypothesis import strategies as st

from tests.contract.independent import faults, firmware
from tests.contract.independent.board import Board
from tests.contract.independent.conversation import (
    BAUD,
    HEALTHY,
    SIX,
    Requested,
    talking,
    without_replies,
)
from tests.contract.independent.faults import Piece, Script


class Read(NamedTuple):
    """One kind of read, behind so many moves, and the pause after it."""

    requested: Requested
    moves: int
    pause: float


class Step(NamedTuple):
    """The fault of the first reply to some reads, and whether a group runs meanwhile."""

    script: Script
    reads: list[Read]
    runs: bool


def a_report(after: float, command: int) -> Piece:
    return Piece(after, firmware.report(command, 8, 1), is_report=True)


short = st.sampled_from([0.0, 0.001, 0.004, 0.009, 0.015, 0.03, 0.045])
long = st.sampled_from([0.06, 0.1, 0.2])
reports = st.builds(
    a_report,
    st.one_of(short, long),
    st.sampled_from([firmware.STARTED, firmware.STOPPED, firmware.COMPLETED]),
)
noise = st.binary(max_size=8).map(lambda data: data.replace(b"UU", b"UV"))
scripts: st.SearchStrategy[Script] = st.one_of(
    st.builds(faults.duplicated, st.one_of(short, long), st.integers(1, 2)),
    st.builds(faults.late, st.sampled_from([0.01, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0])),
    st.just(faults.dropped),
    st.builds(faults.cut, st.integers(0, 22)),
    # Where more is missing, a whole report may hide in what seems a reply: see test_one_fault.
    st.builds(faults.cut, st.integers(-12, -1), reports),
    st.builds(faults.lost, st.integers(0, 8), st.integers(1, 3)),
    st.builds(faults.lost, st.integers(0, 8), st.integers(1, 3), reports),
    st.builds(faults.preceded, noise),
    st.builds(faults.halted, st.integers(1, 22), st.sampled_from([0.01, 0.02, 0.04])),
)
# Two reads are in order before anything else happens: the property is about what one fault does.
reads = st.lists(
    st.builds(
        Read,
        st.sampled_from([None, None, SIX, (1, 2)]),
        st.sampled_from([0, 0, 0, 1, 3]),
        st.sampled_from([0.0, 0.0, 0.0, 0.01, 0.1, 0.4]),
    ),
    min_size=3,
    max_size=5,
)
steps = st.lists(st.builds(Step, scripts, reads, st.booleans()), min_size=1, max_size=4)


@example(
    # A second copy is taken for a reply that is late, and that is a report half a second later.
    [
        Step(faults.duplicated(0.06, 1), [Read(None, 0, 0.0)] * 3, False),
        Step(faults.late(0.7), [Read(None, 0, 0.0)] * 3, False),
    ],
    0.0,
    0.0,
)
@given(steps, st.sampled_from([0.0, 0.001, 0.004]), st.sampled_from([0.0, 0.001, 0.016]))
def test_every_read_is_right_or_excused_by_a_fault(
    steps: list[Step], thinks: float, latency: float
) -> None:
    script_of: dict[int, Script] = {}
    board = Board(baud=BAUD, thinks=thinks, latency=latency, faults=script_of.get)
    received: list[bytes] = []
    with talking(board) as (talk, controller):
        for _ in range(HEALTHY):
            talk.ask(controller, None)
        for step in steps:
            script_of[board.questions + 1] = step.script
            if step.runs:
                controller.run_action_group(8, times=2)
            for read in step.reads:
                for _ in range(read.moves):
                    controller.move_servos([(servo, 500) for servo in SIX], time_ms=1000)
                talk.ask(controller, read.requested)
                if read.pause:
                    received += [each.encode() for each in controller.reports(timeout=read.pause)]
        for _ in range(3):
            talk.ask(controller, SIX)
        received += [each.encode() for each in controller.reports(timeout=2)]
        talk.check()
        assert without_replies([talk], received) == board.reported
        assert board.refused == []
