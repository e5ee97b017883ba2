"""Requests and replies are matched: what was answered, by what, how fast, and what came alone."""

from typing import TypeAlias

import pytest
from framegen.audit.text import as_text

from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn
from tests.lines.tallied_line import audited
from tests.protocols.specs import model_of

ASK, TELL = "55 55 02 0F", "55 55 04 0F 4C 1D"
WHERE, THERE = "55 55 05 15 02 01 02", "55 55 09 15 02 01 F4 01 02 F4 01"
ONE_THERE, OTHER_THERE = "55 55 06 15 01 02 F4 01", "55 55 06 15 01 09 F4 01"
HOST, BOARD = "host", "controller"

GATHER, ONE, TWO = "55 55 FE 03 0E F0", "55 55 01 04 0E 01 EB", "55 55 02 04 0E 02 E9"
ASK_TWO = "55 55 02 03 0E EC"
# Lines as (time, sender, frame); then requests, answered, unanswered, unsolicited, and times.
Line: TypeAlias = tuple[float, str, str]
CASES: dict[str, list[tuple[list[Line], tuple[int, int, int, int], list[float]]]] = {
    "BatteryVoltageRead": [
        ([(0, HOST, ASK), (0.5, BOARD, TELL)], (1, 1, 0, 0), [0.5]),
        ([(0, HOST, ASK), (9, HOST, ASK), (9.25, BOARD, TELL)], (2, 1, 1, 0), [0.25]),
        ([(0, HOST, ASK), (0.5, BOARD, TELL), (1, BOARD, TELL)], (1, 1, 0, 1), [0.5]),
        ([(0, BOARD, TELL), (1, HOST, ASK)], (1, 0, 1, 1), []),
        ([(0, HOST, ASK), (61, BOARD, TELL)], (1, 0, 1, 1), []),
        # Another recording begins: its times do.
        ([(50, HOST, ASK), (0, HOST, ASK), (0.5, BOARD, TELL)], (2, 1, 1, 0), [0.5]),
    ],
    "ServoPositionsRead": [
        ([(0, HOST, WHERE), (0.5, BOARD, THERE)], (1, 1, 0, 0), [0.5]),
        ([(0, HOST, WHERE), (0.5, BOARD, ONE_THERE)], (1, 1, 0, 0), [0.5]),
        ([(0, HOST, WHERE), (0.5, BOARD, OTHER_THERE)], (1, 0, 1, 1), []),
    ],
    # Who is asked together with all others answers, or does not.
    "ServoIdRead": [
        ([(0, HOST, GATHER)], (1, 0, 0, 0), []),
        ([(0, HOST, GATHER), (0.25, "servo", ONE)], (1, 1, 0, 0), [0.25]),
        ([(0, HOST, GATHER), (0.25, "servo", ONE), (0.5, "servo", TWO)], (1, 1, 0, 0), [0.25]),
        ([(0, "servo", ONE), (1, HOST, GATHER)], (1, 0, 0, 1), []),
        ([(0, HOST, GATHER), (61, "servo", ONE)], (1, 0, 0, 1), []),
        # Asked again, it is another request; what comes behind the next one answers that.
        (
            [(0, HOST, GATHER), (0.5, "servo", ONE), (1, HOST, GATHER), (1.25, "servo", ONE)],
            (2, 2, 0, 0),
            [0.5, 0.25],
        ),
        ([(0, HOST, GATHER), (1, HOST, ASK_TWO), (1.5, "servo", ONE)], (2, 0, 1, 1), []),
        ([(0, HOST, ASK_TWO), (0.25, HOST, GATHER), (0.5, "servo", TWO)], (2, 1, 0, 0), [0.5]),
    ],
}


def recording(lines: list[Line]) -> str:
    return "".join(f"{frame}  # {at:f} s, {sender}: a\n" for at, sender, frame in lines)


@in_turn(
    "name, lines, counts, seconds", lambda: ((name, *row) for name in CASES for row in CASES[name])
)
def test_requests_are_matched_with_their_replies(
    name: str, lines: list[Line], counts: tuple[int, ...], seconds: list[float]
) -> None:
    is_bus = name == "ServoIdRead"
    model = model_of("lxservo") if is_bus else compiled_file(BUSSERVO).model
    found = audited(model, recording(lines))
    each = found.conversations.by_request[name]
    assert (each.requests, each.answered, each.unanswered, each.unsolicited) == counts
    assert each.seconds == pytest.approx(seconds)
    raised = {each.message.name for each in found.raised}
    assert (name in raised) is (each.answered > 0) or not is_bus


def test_without_times_the_order_alone_decides() -> None:
    found = audited(compiled_file(BUSSERVO).model, f"{ASK} {TELL} {ASK}")
    each = found.conversations.by_request["BatteryVoltageRead"]
    assert (each.requests, each.answered, each.unanswered, each.seconds) == (2, 1, 1, [])


def test_a_probe_at_another_rate_is_no_request_without_a_reply() -> None:
    probed = (
        f"# opened, at 115200 baud\n{ASK}  # 0 s, host: a\n"
        f"# opened, at 9600 baud\n{ASK}  # 1 s, host: a\n"
    )
    model = compiled_file(BUSSERVO).model
    for text, counts in (
        (f"{probed}{TELL}  # 1.5 s, controller: a\n", (1, 1, 0)),
        # Where nothing came at any rate, none of them is known to be the right one.
        (probed, (2, 0, 2)),
        (f"{probed}{TELL}  # 1.5 s, noise: bad header\n", (2, 0, 2)),
    ):
        each = audited(model, text).conversations.by_request["BatteryVoltageRead"]
        assert (each.requests, each.answered, each.unanswered) == counts


def test_times_that_run_backwards_are_said() -> None:
    model = compiled_file(BUSSERVO).model
    lines = recording([(9, HOST, ASK), (0.5, BOARD, TELL), (0.75, HOST, ASK), (0.25, BOARD, TELL)])
    found = audited(model, lines)
    assert found.backward == ["line 2 of line", "line 4 of line"]
    assert "times run backwards" in "\n".join(as_text(found))
    # Two recordings in one file each have a clock of their own.
    begun = "# recorded of 'a line' from 2026-01-02 09:08:07 +0000 on\n"
    again = recording([(0, HOST, ASK), (0.5, BOARD, TELL)])
    found = audited(model, f"{begun}{again}{begun}{again}")
    assert found.backward == []
    assert "times run backwards" not in "\n".join(as_text(found))


def test_one_end_alone_says_nothing_of_the_other() -> None:
    found = audited(compiled_file(BUSSERVO).model, f"{ASK} {ASK}")
    assert not found.conversations.has_both_ends


def test_another_device_answers_for_itself_alone() -> None:
    model = model_of("lxservo")
    asked = {name: model.messages[name].message.examples for name in model.messages}
    request = next(each for each in model.exchanges if each.reply is not None)
    frame = bytes(asked[request.request.name][0].hex)
    reply = bytes(asked[request.reply.name][0].hex) if request.reply else b""
    address = model.frame.address
    assert address is not None
    other = bytearray(frame)
    other[address.at] = reply[address.at] ^ 1
    sealed = request.request.sealed(bytes(other))
    ends = request.request.direction
    text = "".join(
        f"{data.hex(' ')}  # {at} s, {sender}: a\n"
        for at, sender, data in ((0, ends.sender, sealed), (1, ends.receiver, reply))
    )
    each = audited(model, text).conversations.by_request[request.request.name]
    assert (each.answered, each.unanswered, each.unsolicited) == (0, 1, 1)
