"""Requests and replies are matched: what was answered, by what, how fast, and what came alone."""

import pytest

from tests.audit.line import audited
from tests.factories import BUSSERVO, compiled_file
from tests.protocols.specs import model_of

ASK, TELL = "55 55 02 0F", "55 55 04 0F 4C 1D"
WHERE, THERE = "55 55 05 15 02 01 02", "55 55 09 15 02 01 F4 01 02 F4 01"
ONE_THERE, OTHER_THERE = "55 55 06 15 01 02 F4 01", "55 55 06 15 01 09 F4 01"
HOST, BOARD = "host", "controller"

# Lines as (time, sender, frame); then requests, answered, unanswered, unsolicited, and times.
CASES = [
    ([(0, HOST, ASK), (0.5, BOARD, TELL)], (1, 1, 0, 0), [0.5]),
    ([(0, HOST, ASK), (9, HOST, ASK), (9.25, BOARD, TELL)], (2, 1, 1, 0), [0.25]),
    ([(0, HOST, ASK), (0.5, BOARD, TELL), (1, BOARD, TELL)], (1, 1, 0, 1), [0.5]),
    ([(0, BOARD, TELL), (1, HOST, ASK)], (1, 0, 1, 1), []),
    ([(0, HOST, ASK), (61, BOARD, TELL)], (1, 0, 1, 1), []),
    # Another recording begins: its times do.
    ([(50, HOST, ASK), (0, HOST, ASK), (0.5, BOARD, TELL)], (2, 1, 1, 0), [0.5]),
]
POSITIONS = [
    ([(0, HOST, WHERE), (0.5, BOARD, THERE)], (1, 1, 0, 0)),
    ([(0, HOST, WHERE), (0.5, BOARD, ONE_THERE)], (1, 1, 0, 0)),
    ([(0, HOST, WHERE), (0.5, BOARD, OTHER_THERE)], (1, 0, 1, 1)),
]


def recording(lines: list[tuple[float, str, str]]) -> str:
    return "".join(f"{frame}  # {at:f} s, {sender}: a\n" for at, sender, frame in lines)


@pytest.mark.parametrize(("lines", "counts", "seconds"), CASES)
def test_requests_are_matched_with_their_replies(
    lines: list[tuple[float, str, str]], counts: tuple[int, ...], seconds: list[float]
) -> None:
    found = audited(compiled_file(BUSSERVO).model, recording(lines))
    each = found.conversations.by_request["BatteryVoltageRead"]
    assert (each.requests, each.answered, each.unanswered, each.unsolicited) == counts
    assert each.seconds == pytest.approx(seconds)


@pytest.mark.parametrize(("lines", "counts"), POSITIONS)
def test_a_reply_repeats_what_it_answers(
    lines: list[tuple[float, str, str]], counts: tuple[int, ...]
) -> None:
    found = audited(compiled_file(BUSSERVO).model, recording(lines))
    each = found.conversations.by_request["ServoPositionsRead"]
    assert (each.requests, each.answered, each.unanswered, each.unsolicited) == counts


def test_without_times_the_order_alone_decides() -> None:
    found = audited(compiled_file(BUSSERVO).model, f"{ASK} {TELL} {ASK}")
    each = found.conversations.by_request["BatteryVoltageRead"]
    assert (each.requests, each.answered, each.unanswered, each.seconds) == (2, 1, 1, [])


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
