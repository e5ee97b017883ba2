"""Long runs with the independent board, with a fault for every fourth reply.

`make soak` makes a hundred thousand calls, the tests some seconds of them. Only calculated time
passes at a line of 9600 baud; eight threads share one over TCP that is as fast as it can be.
"""

import math
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from random import Random

from busservo import Controller, open_controller

from tests.contract.independent import faults, firmware
from tests.contract.independent.board import Board
from tests.contract.independent.conversation import (
    BAUD,
    REPLY_TIMEOUT,
    SIX,
    Conversation,
    Requested,
    talking,
    without_replies,
)
from tests.contract.independent.faults import Script
from tests.contract.independent.ports import TcpPort
from tests.lines.growth import Growth
from tests.timeouts import GENEROUS, await_that

# The other end is a thread of the same busy machine.
LIVE_REPLY_TIMEOUT = 5.0
THREADS = 8
KINDS: list[Requested] = [None, None, SIX, (1, 2)]


def a_report(random: Random) -> bytes:
    """Return one of the three reports, of any group."""
    command = random.choice([firmware.STARTED, firmware.STOPPED, firmware.COMPLETED])
    return firmware.report(command, random.randrange(256), random.randrange(3))


def any_fault(random: Random) -> Script:
    """Return a fault that can happen on a line with a pace."""
    piece = faults.Piece(random.choice([0.0, 0.004, 0.02, 0.1]), a_report(random), is_report=True)
    return random.choice(
        [
            faults.duplicated(random.choice([0.0, 0.002, 0.006, 0.02, 0.1])),
            faults.late(random.choice([0.01, 0.2, 0.5, 1.0])),
            faults.dropped,
            faults.cut(random.randrange(1, 12)),
            faults.cut(random.choice([-1, -2, -3]), piece),
            faults.lost(random.randrange(8), random.randrange(1, 4)),
            faults.halted(random.randrange(1, 6), random.choice([0.001, 0.01, 0.04])),
            *harmless_faults(random),
        ]
    )


def harmless_faults(random: Random) -> list[Script]:
    """Return a fault that leaves the reply's value as it is, or none."""
    return [
        faults.preceded(b"\x55\xaa"),
        faults.preceded(a_report(random), is_report=True),
        faults.followed(a_report(random), is_report=True),
    ]


class Rounds:
    """A check after each round: all was right, all reports came, and nothing grows."""

    def __init__(self, name: str, board: Board, controller: Controller) -> None:
        self._board = board
        self._controller = controller
        self._growth = Growth(f"independent board, {name}")
        self._right = self._refused = self._stale = 0

    def end(
        self, talks: Sequence[Conversation], baud: float, reply_timeout: float, quiet: float
    ) -> None:
        """Check one round, once the line has been `quiet` for some seconds, and forget it."""
        board, controller = self._board, self._controller
        received = [each.encode() for each in controller.reports(timeout=quiet)]
        reports = without_replies(talks, received)
        for talk in talks:
            talk.check(baud, reply_timeout)
            self._refused += len(talk.failed)
            self._stale += len(talk.stale)
            self._right += len(talk.calls) - len(talk.failed) - len(talk.stale)
            talk.calls.clear()
        assert reports == board.reported, "a report was lost, or invented"
        assert controller.counters.lost_reports == 0
        assert board.refused == []
        for kept in (board.reported, board.faulty, board.troubles):
            kept.clear()
        self._growth.round(board.questions)

    def print_result(self) -> None:
        """Print the result. Raises AssertionError if something has grown."""
        counters = self._controller.counters
        self._growth.end(
            self._board.questions,
            f"{self._right} answered rightly, {self._stale} stale where no time can tell, "
            f"{self._refused} ended in a declared error, {counters.lost_reports} lost: {counters}",
        )


def scheduled(random: Random, fault: Callable[[Random], Script]) -> Callable[[int], Script | None]:
    """Return a fault for every fourth reply."""
    return lambda number: fault(random) if number % 4 == 0 else None


def at_a_paced_line(requests: int, rounds: int, seed: int) -> None:
    """Run one thread, in virtual time, with any fault."""
    random = Random(seed)  # noqa: S311 - to be repeated
    board = Board(baud=BAUD, thinks=0.001, faults=scheduled(random, any_fault))
    with talking(board) as (talk, controller):
        watch = Rounds("paced", board, controller)
        for _ in range(rounds):
            for _ in range(requests // rounds):
                talk.ask(controller, random.choice(KINDS))
            watch.end([talk], BAUD, REPLY_TIMEOUT, quiet=2)
        watch.print_result()


def with_threads(requests: int, rounds: int, seed: int) -> None:
    """Run eight threads, over TCP, as fast as can be: without a pace, no reply comes twice."""
    random = Random(seed)  # noqa: S311 - to be repeated
    board = Board(faults=scheduled(random, lambda each: each.choice(harmless_faults(each))))
    with (
        TcpPort(board) as port,
        open_controller(port.name, baud=math.inf, reply_timeout=LIVE_REPLY_TIMEOUT) as controller,
        ThreadPoolExecutor(THREADS) as pool,
    ):
        watch = Rounds(f"{THREADS} threads", board, controller)
        talks = [Conversation(board, time.monotonic) for _ in range(THREADS)]
        size = requests // rounds // THREADS

        def ask(talk: Conversation) -> None:
            for turn in range(size):
                talk.ask(controller, KINDS[turn % len(KINDS)])

        for _ in range(rounds):
            list(pool.map(ask, talks))
            await_that(lambda: controller.counters.reports >= len(board.reported))
            wrong = [each for talk in talks for each in talk.failed + talk.stale]
            assert wrong == [], f"{wrong}, {controller.counters}"
            watch.end(talks, math.inf, GENEROUS, quiet=0.02)
        watch.print_result()
