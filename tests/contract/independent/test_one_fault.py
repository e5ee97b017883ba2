"""One fault in a row of reads, in virtual time at 9600 baud: each kind, for each kind of read.

The wire takes its time both ways, and the client is given the true baud rate.
"""

from typing import NamedTuple

from tests.contract.independent import faults, firmware
from tests.contract.independent.board import BITS_PER_BYTE, Board
from tests.contract.independent.conversation import BAUD, SIX, Requested, talking
from tests.contract.independent.faults import Piece, Script
from tests.in_turn import in_turn

READS = {"battery": None, "six positions": SIX}
REPORT = firmware.report(firmware.COMPLETED, 8, 1)
STOPPED = firmware.report(firmware.STOPPED)
# The question whose reply it happens to.
FAULTY = 4


def later(after: float, data: bytes = REPORT) -> Piece:
    """Return a report, some time after the reply."""
    return Piece(after, data, is_report=True)


class Bench(NamedTuple):
    """The timing of a board and its adapter."""

    thinks: float = 0.0
    latency: float = 0.0


BENCHES = [Bench(), Bench(thinks=0.002), Bench(thinks=0.003, latency=0.001), Bench(latency=0.016)]
FAULTS: dict[str, Script] = {
    "duplicated": faults.duplicated(),
    "duplicated twice": faults.duplicated(copies=2),
    "duplicated after 5 ms": faults.duplicated(0.005),
    "duplicated after 30 ms": faults.duplicated(0.030),
    "duplicated after 200 ms": faults.duplicated(0.2),
    "dropped": faults.dropped,
    "late, but in time": faults.late(0.2),
    "later than its time": faults.late(0.4),
    "later than twice its time, behind the next": faults.late(0.55),
    "later than twice its time": faults.late(0.7),
    "later than four times its time": faults.late(1.4),
    "cut in the header": faults.cut(1),
    "cut behind the header": faults.cut(2),
    "cut behind the command": faults.cut(4),
    "the last byte is lost": faults.cut(5),
    "cut, a report at once": faults.cut(4, later(0.0)),
    "cut, a report after 5 ms": faults.cut(4, later(0.005)),
    "cut, a report after 40 ms": faults.cut(4, later(0.040)),
    "cut, a report after 60 ms": faults.cut(4, later(0.060)),
    "cut, a report after 200 ms": faults.cut(4, later(0.2)),
    "cut, the shortest report at once": faults.cut(4, later(0.0, STOPPED)),
    "cut, the shortest report after 20 ms": faults.cut(4, later(0.020, STOPPED)),
    "cut one byte later, a report at once": faults.cut(5, later(0.0)),
    "the first byte is lost": faults.lost(0, 1),
    "the length is lost": faults.lost(2, 1),
    "two bytes are lost within": faults.lost(3, 2),
    "two bytes are lost within, a report at once": faults.lost(3, 2, later(0.0)),
    "wrong length": faults.mislengthened(1),
    "noise before": faults.preceded(b"\x00\xff\x55"),
    "half a header before": faults.preceded(b"\x55"),
    "the header of a longer reply before": faults.preceded(b"\x55\x55\x15\x15"),
    "a report before": faults.preceded(REPORT, is_report=True),
    "a report behind": faults.followed(REPORT, is_report=True),
    "noise behind": faults.followed(b"\x55\x55"),
    "a pause of 20 ms within": faults.halted(5, 0.020),
}
# These leave a frame of the right shape, with other numbers in it, where it is the battery's.
OF_POSITIONS = {"wrong count": faults.miscounted(-1), "count too high": faults.miscounted(1)}
# All requests are answered, and in time.
HARMLESS = {
    *("noise before", "half a header before", "a report before"),
    *("a report behind", "noise behind", "a pause of 20 ms within"),
}


class Run:
    """A row of reads, one after the other without a pause."""

    def __init__(
        self,
        requested: Requested,
        script: Script | None,
        bench: Bench,
        reads: int = 9,
        first: int = 1,
    ) -> None:
        script_of = {first + FAULTY - 1: script}.get
        self.board = Board(baud=BAUD, faults=script_of, first=first, **bench._asdict())
        with talking(self.board) as (self.talk, controller):
            for _ in range(reads):
                self.talk.ask(controller, requested)
            # All that is still to come is with the host by then, and the line has been quiet since.
            quiet = self.board.last_event - self.talk.now() + 0.2
            self.reports = [each.encode() for each in controller.reports(timeout=quiet)]
            self.counters = controller.counters

    def check(self) -> None:
        self.talk.check()
        assert self.reports == self.board.reported
        assert self.board.refused == []


def all_faults() -> list[tuple[str, str]]:
    """Return each kind of read with each fault that can happen to it."""
    of = {"battery": FAULTS, "six positions": FAULTS | OF_POSITIONS}
    return [(read, name) for read in READS for name in of[read]]


# From 1 on; and as half a header and a whole one, which may begin a frame in the end of each reply.
@in_turn("first, benches", lambda: [(1, BENCHES), (0x5500, BENCHES[1::2]), (0x5550, BENCHES[1::2])])
@in_turn("read, name", all_faults)
def test_after_any_fault_the_second_next_read_is_right(
    read: str, name: str, first: int, benches: list[Bench]
) -> None:
    script = (FAULTS | OF_POSITIONS)[name]
    for bench in benches:
        run = Run(READS[read], script, bench, first=first)
        run.check()
        if name in HARMLESS and first == 1:
            assert run.talk.failed == []


@in_turn("read", lambda: READS)
def test_a_duplicate_shifts_nothing(read: str) -> None:
    """A reply that came twice made 77 of 80 reads stale, without an error or a count."""
    for bench in BENCHES:
        run = Run(READS[read], faults.duplicated(), bench, reads=80)
        run.check()
        assert (run.talk.stale, run.talk.failed) == ([], [])
        # Where the adapter hands over both at once, neither is taken, and the read is repeated.
        at_once = bench.latency > 0.01 and READS[read] is None
        assert (run.counters.unsolicited, run.counters.retries) == (1 + at_once, at_once)
        assert run.counters.replies == 80


BYTE = BITS_PER_BYTE / BAUD
# A question of 4 bytes, a reply of 6, and a board that then thinks for 7.7. How long after its own
# reply a duplicate is due, and whether the next read is stale: it is where the duplicate is whole
# after question and reply can have come, if the line is a little fast, and before the reply is.
# Where a board thinks for longer than the wire takes, the right reply then comes when that to the
# next question could: it is waited for.
WINDOW = {
    "at once": (0, False, 0.008),
    "before question and reply fit": (9.4, False, 0.008),
    "when question and reply fit": (10.1, True, 0.008),
    "while the board thinks": (14, True, 0.008),
    "behind the reply": (17.8, False, 0.008),
    "when they fit, at a slow board": (10.1, True, 0.020),
    "while a slow board thinks": (14, True, 0.020),
    "while a slow board thinks, later": (18, True, 0.020),
}


@in_turn("name", lambda: WINDOW)
def test_one_read_at_most_is_stale_where_time_cannot_distinguish_replies(name: str) -> None:
    after, stale, thinks = WINDOW[name]
    run = Run(None, faults.duplicated(after * BYTE), Bench(thinks), reads=20)
    run.check()
    assert [run.talk.calls.index(each) for each in run.talk.stale] == [FAULTY] * stale
    assert run.counters.unsolicited == 1
    assert run.talk.failed == []
