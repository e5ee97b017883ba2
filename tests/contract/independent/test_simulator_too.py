"""The property of the independent board, held to the simulator: by seed, at 9600 baud.

It does not record when a fault happened, so that every fault is over before the last reads, which
must be right. No stale value may come of a reply that was impossible, whatever happens.
"""

import bisect

from busservo_simulator import Faults, VirtualController
from hypothesis import example, given
from hypothesis import strategies as st

from tests.contract.independent.conversation import (
    BAUD,
    HEALTHY,
    SIX,
    talking,
    wire_time,
    without_replies,
)
from tests.lines.at_board import virtual_board
from tests.lines.conversation import Numbering

# By then, all that was late is there.
QUIET = 3.0


class Simulated(Numbering):
    """A simulated board that numbers its replies: a transport that records bytes and times."""

    name = "simulator"

    def __init__(self, board: VirtualController) -> None:
        super().__init__(board)
        self.calm_at = float("inf")
        self.clock = board.clock.now
        self._transport = board.transport
        self.write, self.drain = self._transport.write, self._transport.drain
        self.close = self._transport.close
        self._stream = bytearray()
        # How many bytes there were by then, and when that was.
        self._sizes: list[int] = []
        self._times: list[float] = []
        # When the board received each question.
        self._asked_at = [float("-inf")]

    def read(self, timeout: float) -> bytes:
        data = self._transport.read(timeout)
        self._stream += data
        self._sizes.append(len(self._stream))
        self._times.append(self.clock())
        return data

    def asked_at(self, number: int) -> float:
        return self._asked_at[number]

    def arrivals(self, data: bytes) -> list[float]:
        found = []
        at = self._stream.find(data)
        while at >= 0:
            found.append(self._times[bisect.bisect_left(self._sizes, at + len(data))])
            at = self._stream.find(data, at + 1)
        return found

    def troubled(self, since: float, until: float) -> bool:  # noqa: ARG002 - it ends by itself
        return since < self.calm_at

    def faulted(self, since: float, until: float) -> bool:
        return self.troubled(since, until)

    def _next(self) -> int:
        self._asked_at.append(self.clock())
        return super()._next()


chance = st.sampled_from([0.0, 0.0, 0.1, 0.3])
# Of bytes that are lost, a report may take the place: what comes of that, other tests have.
whole = st.builds(
    Faults,
    seed=st.integers(0, 2**32),
    duplicated=chance,
    late=chance,
    late_by=st.sampled_from([0.05, 0.3, 0.7, 1.0]),
    noise=chance,
    splits=chance,
    coalesced=chance,
    delays=chance,
    longest_delay=st.sampled_from([0.01, 0.3, 1.0]),
    dropped=chance,
    wrong_count=chance,
    unsolicited=chance,
)
holed = st.builds(
    Faults,
    seed=st.integers(0, 2**32),
    lost_bytes=st.sampled_from([0.01, 0.05, 0.1]),
    noise=chance,
    dropped=chance,
)


@example(
    # Asked three times, behind a lost reply: one that was late, and two that a report delayed.
    Faults(
        seed=312489,
        late=0.1,
        late_by=0.7,
        splits=0.3,
        delays=0.1,
        longest_delay=1.0,
        dropped=0.1,
        wrong_count=0.1,
        unsolicited=0.3,
    ),
    [None, SIX, SIX, None, None],
)
@example(
    # A second copy, late by so much that it may have come by itself.
    Faults(
        seed=2905329299,
        coalesced=0.1,
        delays=0.1,
        longest_delay=1.0,
        late=0.3,
        late_by=0.7,
        duplicated=0.1,
    ),
    [None],
)
@example(
    # A second copy of what was dropped in doubt comes for the answer to the question asked again.
    Faults(
        seed=4265632045,
        noise=0.1,
        coalesced=0.3,
        delays=0.3,
        longest_delay=0.01,
        late=0.3,
        late_by=0.7,
        duplicated=0.1,
        dropped=0.3,
        wrong_count=0.1,
    ),
    [SIX, (1, 2), None, None, None],
)
@given(st.one_of(whole, holed), st.lists(st.sampled_from([None, SIX, (1, 2)]), max_size=8))
def test_every_read_from_the_faulty_simulator_is_right_or_excused(
    faults: Faults, requested: list[tuple[int, ...] | None]
) -> None:
    with virtual_board(baud=BAUD) as board:
        simulated = Simulated(board)
        with talking(simulated, simulated) as (talk, controller):
            for _ in range(HEALTHY):
                talk.ask(controller, None)
            board.faults = faults
            simulated.note_reports(board)
            for each in requested:
                talk.ask(controller, each)
            board.faults = Faults()
            received = list(controller.reports(timeout=QUIET))
            simulated.calm_at = board.clock.now()
            for _ in range(3):
                talk.ask(controller, None)
            talk.check()
            reports = without_replies([talk], [each.encode() for each in received])
            assert reports == [each.encode() for each in simulated.reported]


def test_reads_come_no_faster_than_the_line_allows() -> None:
    """Some replies come up to a second late: with each seed, most reads after them came early."""
    for seed in range(4):
        faults = Faults(seed=seed, delays=0.04, longest_delay=1.0)
        with virtual_board(baud=BAUD, faults=faults) as board:
            simulated = Simulated(board)
            with talking(simulated, simulated) as (talk, controller):
                for _ in range(100):
                    talk.ask(controller, None)
            least = 0.95 * wire_time(None, BAUD)
            early = [call for call in talk.calls if call.ended - call.began < least]
            assert early == []
            talk.check()
