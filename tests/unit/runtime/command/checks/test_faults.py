"""The doctor's results for each fault of the virtual board, in virtual time."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import pytest
from busservo import ActionGroupStarted
from busservo_simulator import Faults, VirtualController
from framewire.command.checks.result import FAILED, PASSED, UNKNOWN

from tests.in_turn import in_turn
from tests.lines.patient import CHECKS, LONGEST, board_with, diagnosis_of, examined

Expected = dict[str, tuple[str, str, str]]


@dataclass
class Case:
    """A fault, and the checks that do not pass, each with its state and text."""

    faults: Faults = field(default_factory=Faults)
    expected: Expected = field(default_factory=dict)
    board: dict[str, Any] = field(default_factory=dict)
    given: dict[str, Any] = field(default_factory=dict)
    before: Callable[[VirtualController], object] = lambda _board: None


def failed(**texts: tuple[str, str]) -> Expected:
    """Return the checks that fail, by their names with underscores, with texts and advice."""
    return {name.replace("_", "-"): (FAILED, *said) for name, said in texts.items()}


def sending(frame: str) -> Callable[[VirtualController], object]:
    return lambda board: board.send_bytes(bytes.fromhex(frame))


NO_REPLY = {
    "reply": (UNKNOWN, "there was no reply to look at", ""),
    "round-trip": (UNKNOWN, "there was no reply to measure", ""),
    "present": (UNKNOWN, "there is no reply to anything", ""),
}
NOTHING = NO_REPLY | {"look-alike": (UNKNOWN, "nothing came", "")}
SILENT = NOTHING | failed(rate=("nothing came at all", "TX goes to RX"))
LOST = dict.fromkeys(
    ("echo", "reply", "round-trip", "present", "look-alike"),
    (UNKNOWN, "not looked at: see the check `rate`", ""),
)
BY_NOISE = failed(reply=("answered by bytes that are no reply", "loose plugs"))
NO_FRAME, SEE_RATE = "bytes that are no frame", "see that the rate"
UNSOLICITED, AT_WHICH = f"{NO_FRAME} came unsolicited", "at which rate the device is set"
NO_RATE = {"round-trip": (UNKNOWN, "this is no line of that rate", "baud=math.inf")}
ECHO: dict[str, Any] = {"local_echo": True}
AT_ONCE: dict[str, Any] = {"baud": None}
OFTEN_LATE, MORE = Faults(late=0.3, late_by=1.5, seed=3), "of 11 questions 11 answered"
SUPPLY, TX, GROUNDS = "supply of the servos", "TX goes to RX", "grounds"
NOT_THIS, REPORT_IT = "does not know this question", "send a report in"
ALONE = failed(rate=("which are the question itself", TX), echo=("came back 2 of 2 times", "say"))
LATE_AND_TWICE = failed(
    reply=("1 answered more than once, 1 answered too late", "--timeout 2"),
    round_trip=("before the line could have carried", "an earlier question"),
)


def spurious(board: VirtualController, **how: bool) -> None:
    board.spurious_output(b"\x00\xf8", 20, **how)


def heard(board: VirtualController) -> None:
    spurious(board, ignore_input=False)


def started(board: VirtualController) -> None:
    board.report(ActionGroupStarted(3, 1))


# What the checks `silence` and `look-alike` say of bytes that nobody asked for.
SPURIOUS = failed(silence=(UNSOLICITED, SEE_RATE), reply=("answered with noise around it", GROUNDS))
NOISE_ALONE = failed(silence=(UNSOLICITED, SEE_RATE), rate=("that are no reply", AT_WHICH))
EDITION = failed(
    silence=(f"5 {NO_FRAME}", SEE_RATE), look_alike=("a frame of command 99 came", REPORT_IT)
)
LENGTH = failed(
    silence=(f"8 {NO_FRAME}", SEE_RATE),
    look_alike=("BatteryVoltage came with 8 bytes, which none has", REPORT_IT),
)
CASES = {
    "nothing": Case(),
    "noise": Case(Faults(noise=1.0), failed(reply=(f"{MORE} with noise around it", GROUNDS))),
    "some bits": Case(Faults(bit_flips=0.03, seed=3), BY_NOISE),
    "lost bytes": Case(Faults(lost_bytes=0.02, seed=1), BY_NOISE),
    "pieces": Case(Faults(splits=1.0)),
    "together": Case(Faults(coalesced=1.0)),
    "a little late": Case(Faults(late=1.0, late_by=0.2)),
    "late": Case(Faults(late=1.0, late_by=0.6), failed(reply=(f"{MORE} too late", "--timeout 2"))),
    "far too late": Case(Faults(late=1.0, late_by=100.0), SILENT),
    "twice": Case(
        Faults(duplicated=1.0), failed(reply=(f"{MORE} more than once", "no other program"))
    ),
    "never": Case(Faults(dropped=1.0), SILENT),
    "sometimes": Case(
        Faults(dropped=0.5, seed=6), failed(reply=("5 questions 3 not", "retries=2 asks"))
    ),
    "reports": Case(Faults(unsolicited=1.0)),
    "hung up": Case(Faults(hang_up=1.0), LOST | failed(rate=("virtual board: ", "run this again"))),
    "pieces to the board": Case(Faults(splits_to_board=1.0)),
    "no servo": Case(
        expected=failed(present=("servos that are there: none", SUPPLY)), board={"servos": []}
    ),
    "all servos off": Case(
        Faults(absent=1.0), failed(present=("none; reported absent: 6", SUPPLY))
    ),
    "some servos missing": Case(Faults(fewer=0.5, seed=1)),
    "wrong counts": Case(
        Faults(wrong_count=1.0), failed(present=("servos 1 to 84 was not answered", NOT_THIS))
    ),
    "echo": Case(
        expected=failed(echo=("came back 1 of 1 times: a local echo", "say --local-echo")),
        board=ECHO,
    ),
    "echo that is known": Case(board=ECHO, given=ECHO),
    "no echo, against expectation": Case(
        given=ECHO, expected=failed(echo=("came back 0 of 1 times", "leave out --local-echo"))
    ),
    "echo alone": Case(Faults(dropped=1.0), NOTHING | ALONE, ECHO),
    "as fast as can be": Case(board=AT_ONCE, expected=NO_RATE),
    "and a pause": Case(Faults(delays=0.5, longest_delay=0.1), NO_RATE, AT_ONCE),
    "as fast as can be, and late": Case(OFTEN_LATE, LATE_AND_TWICE, AT_ONCE),
    "as fast as can be, and said to be": Case(board=AT_ONCE, given={"baud": math.inf}),
    "spurious output": Case(expected=SPURIOUS, before=heard),
    "spurious output and nothing else": Case(
        expected=NO_REPLY | NOISE_ALONE | {"look-alike": (UNKNOWN, "not recognised", AT_WHICH)},
        before=spurious,
    ),
    "a report": Case(before=started),
    "a report and nothing else": Case(
        Faults(dropped=1.0), NO_REPLY | failed(rate=("nothing came at all", TX)), before=started
    ),
    "another edition": Case(expected=EDITION, before=sending("55 55 03 63 01")),
    "the beginning of another length": Case(
        expected=failed(silence=(f"4 {NO_FRAME}", SEE_RATE)), before=sending("55 55 06 0F")
    ),
    "another length": Case(expected=LENGTH, before=sending("55 55 06 0F 4C 1D 00 00")),
}


@in_turn("name", lambda: CASES)
def test_each_fault_is_reported_by_the_checks_that_detect_it(name: str) -> None:
    check_case(CASES[name])


@pytest.mark.garbage
def test_requests_refused_by_the_board_are_no_fault_of_the_return_line() -> None:
    check_case(Case(Faults(noise_to_board=1.0)))


def check_case(case: Case) -> None:
    with board_with(case.faults, **case.board) as board:
        case.before(board)
        found = examined(diagnosis_of(board, **case.given))
        assert board.clock.now() < LONGEST
    assert [*found] == [check.id for check in CHECKS]
    states = {name: result.state for name, result in found.items()}
    expected = {name: state for name, (state, _, _) in case.expected.items()}
    assert states == dict.fromkeys(states, PASSED) | expected, found
    for name, (_, seen, advice) in case.expected.items():
        assert seen in found[name].seen
        assert advice in found[name].advice
        assert found[name].advice or found[name].state == UNKNOWN
