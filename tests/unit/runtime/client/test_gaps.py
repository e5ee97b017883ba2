"""A frame with a gap is no frame, and a silence tells that no longer one comes."""

from collections.abc import Iterator

import pytest
from busservo import BatteryVoltage, NoReplyError, ServoPositionsRead
from framewire.codec.gap import GAP

from tests.factories import data_of, files_of, imported, library_of
from tests.in_turn import in_turn
from tests.lines import questions
from tests.lines.questions import REPLY_TIMEOUT, TRIP, asked, say
from tests.lines.stories import ask, counted, failed, hear, pending, replied, tick, told
from tests.mutations.places import having
from tests.protocols.specs import FILES

FRAME = BatteryVoltage(7500).encode()
TORN = FRAME[:4]


END = TRIP + REPLY_TIMEOUT
MAYBE_TORN = bytes.fromhex("55 55 06 15 01 01 55 55")
# What claims to be positions of 84 servos; a voltage may be in the middle of it.
LONG_HEADER = b"\x55\x55\xff\x15\x54"
test_a_gap_ends_a_frame = told(
    {
        "not a short one": [
            *[ask(), hear(0.01, TORN), tick(0.059), hear(0.09, FRAME[4:]), replied(7500)]
        ],
        "a longer one": [
            *[ask(), hear(0.01, TORN), tick(0.061), hear(0.09, FRAME[4:]), tick(0.15)],
            *[pending, counted(noise=len(FRAME))],
        ],
        # A process that was stopped for a second finds the rest at once: nobody knows when it came.
        "where the port was found empty": [
            *[ask(), hear(0.01, TORN), tick(0.005), hear(1.01, FRAME[4:]), tick(1.005)],
            replied(7500),
        ],
        "and no reply that may be torn, until the line is quiet": [
            *[ask(), hear(0.02, 0x5555), pending, tick(0.02 + GAP), replied(0x5555)]
        ],
        "and such a reply is as old as its bytes: still sooner than the wire allows": [
            *[ask(0.0, ServoPositionsRead([1])), hear(0.001, MAYBE_TORN), tick(0.001 + GAP)],
            *[pending, counted(impossible=1)],
        ],
        "and no reply that is under way when the time is up": [
            *[ask(), hear(END - 0.001, FRAME[:3]), tick(END), hear(END + 0.003, FRAME[3:])],
            replied(7500),
        ],
        "but a line that never falls silent does not keep a question for ever": [
            *[ask(), *(step for n in range(1, 25) for step in (hear(n / 25, b"UU"), tick(n / 25)))],
            failed(NoReplyError),
        ],
        "and a reply behind a false header is found in time on such a line": [
            *[ask(), hear(0.02, LONG_HEADER, FRAME)],
            *(step for n in range(3, 16) for step in (tick(n / 50), hear(n / 50, b"\x00"))),
            *[pending, tick(END + GAP), replied(7500), counted(timeouts=0)],
        ],
    }
)


# ------------------------------------------------------------------ the beginning of a longer one
@pytest.fixture(scope="module")
def libraries() -> Iterator[None]:
    """Import libraries; in one, the fault of the gauges may come instead of a pressure, too."""
    refusal = {"protocol.name": "refusing", "messages.PressureRead.refusal": "Fault"}
    refusing = files_of(having(data_of(FILES["gauges"]), refusal))
    with imported(refusing, *(library_of(FILES[name]) for name in ("gauges", "roboclaw"))):
        yield


def test_a_report_is_there_once_no_longer_frame_comes(libraries: None) -> None:
    line, request, kinds = asked("gauges", "PressureRead")
    fault = kinds.Fault(7)
    say(line, 0.1, fault)
    assert line.tick_at == pytest.approx(0.1 + GAP)
    assert line.counters.reports == 0
    line.tick(0.1 + GAP)
    assert line.reports.take() == fault
    assert not request.done


def test_a_reply_that_begins_like_a_report_is_a_reply(libraries: None) -> None:
    line, request, kinds = asked("gauges", "PressureRead")
    pressure = kinds.Pressure(0x0728)
    assert pressure.encode().startswith(kinds.Fault(7).encode())
    for at, byte in enumerate(pressure.encode()):
        say(line, 0.1 + at / 1000, bytes([byte]))
        line.tick(0.1 + at / 1000)
    assert request.reply == pressure
    assert (line.counters.reports, line.counters.noise) == (0, 0)


# Also so near the end of its time.
@in_turn("before_the_end", lambda: [0.15, 0.001])
def test_of_two_answers_the_shorter_waits(libraries: None, before_the_end: float) -> None:
    line, request, kinds = asked("refusing", "PressureRead")
    at = request.deadline - before_the_end
    say(line, at, kinds.Fault(7))
    line.tick(at + GAP / 2)
    assert not request.done
    line.tick(at + GAP)
    assert request.reply == kinds.Fault(7)


def test_an_answer_waits_for_nothing_that_nobody_has_asked_for(libraries: None) -> None:
    line, request, kinds = asked("roboclaw", "VoltageRead")
    say(line, 0.1, kinds.Voltage(120))
    assert line.tick_at == pytest.approx(0.1)
    line.tick(0.1)
    assert request.reply == kinds.Voltage(120)
    # Nothing is left of it: the next is read as it comes.
    say(line, 0.11, b"\0")
    assert line.tick_at == pytest.approx(0.11 + GAP)


def test_it_waits_where_a_longer_one_may_come_late(libraries: None) -> None:
    line, late, kinds = asked("roboclaw", "VersionRead")
    line.cancel(late)
    request = questions.ask(line, 0.01, kinds.VoltageRead())
    say(line, 0.1, kinds.Voltage(120))
    line.tick(0.1)
    assert not request.done
    line.tick(0.1 + GAP)
    assert request.reply == kinds.Voltage(120)
