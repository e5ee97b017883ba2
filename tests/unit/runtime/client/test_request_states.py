"""What a request goes through: each step of the table happens, and nothing else can."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, ServoMove, TransportError
from busservo._library import LIBRARY
from framewire.client import session
from framewire.client.request import STATES, Request, State, Step
from framewire.client.session import Session

from tests.lines.questions import ask

if TYPE_CHECKING:
    from collections.abc import Callable

# As soon as the wire can have carried question and reply, and far too soon.
IN_TIME, TOO_SOON = 10 / 960, 0.001


def answer(line: Session, now: float, voltage: int = 7500) -> None:
    line.receive(BatteryVoltage(voltage).encode(), now)


def sent(line: Session) -> Request:
    return ask(line, 0.0)


def held(line: Session) -> Request:
    request = ask(line, 0.0)
    answer(line, TOO_SOON)
    return request


def held_twice(line: Session) -> Request:
    request = held(line)
    answer(line, 2 * TOO_SOON)
    return request


def dropped(line: Session) -> Request:
    """Of a line that has kept its rate, one reply that is impossible is meant for another."""
    for number in range(8):
        ask(line, number)
        answer(line, number + IN_TIME)
    request = ask(line, 9.0)
    answer(line, 9.0 + TOO_SOON)
    line.tick(9.0 + IN_TIME + 0.25)
    return request


def tried_again(line: Session) -> Request:
    request = ask(line, 0.0, retries=1)
    line.tick(1.0)
    return request


def tried_again_in_doubt(line: Session) -> Request:
    request = held(line)
    answer(line, IN_TIME, 1)
    return request


def replaced(line: Session) -> Request:
    line.submit(ServoMove(0, [(each, 0) for each in range(80)]), latest=True)
    line.outgoing(0.0)
    request = line.submit(ServoMove(0, [(1, 1)]), latest=True)
    line.submit(ServoMove(0, [(1, 2)]), latest=True)
    return request


def answered(line: Session) -> Request:
    request = ask(line, 0.0)
    answer(line, IN_TIME)
    return request


def given_up(line: Session) -> Request:
    request = ask(line, 0.0)
    line.tick(1.0)
    return request


def given_up_while_held(line: Session) -> Request:
    request = held(line)
    line.fail(TransportError("the line", "it was lost", "plug it in"))
    return request


STORIES = [
    (sent, (State.WAITING, Step.SEND), State.PENDING),
    (replaced, (State.WAITING, Step.FINISH), State.DONE),
    (held, (State.PENDING, Step.HOLD), State.HELD),
    (tried_again, (State.PENDING, Step.RETRY), State.WAITING),
    (given_up, (State.PENDING, Step.FINISH), State.DONE),
    (held_twice, (State.HELD, Step.HOLD), State.HELD),
    (dropped, (State.HELD, Step.DROP), State.PENDING),
    (tried_again_in_doubt, (State.PENDING, Step.RETRY), State.WAITING),
    (given_up_while_held, (State.HELD, Step.FINISH), State.DONE),
    (answered, (State.HELD, Step.FINISH), State.DONE),
]


def test_each_step_of_the_table_has_an_example() -> None:
    table = {(state, step) for state, steps in STATES.items() for step in steps}
    assert {last for _, last, _ in STORIES} == table


@pytest.mark.parametrize(("story", "last", "then"), STORIES)
def test_each_step_of_the_table_happens(
    story: Callable[[Session], Request],
    last: tuple[State, Step],
    then: State,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    taken: dict[int, list[tuple[State, Step]]] = {}
    take = Request.take

    def noted(request: Request, step: Step) -> None:
        taken.setdefault(id(request), []).append((request.state, step))
        take(request, step)

    monkeypatch.setattr(Request, "take", noted)
    line = Session(LIBRARY, baud=9600, reply_timeout=0.5, report_limit=16)
    request = story(line)
    assert (taken[id(request)][-1], request.state) == (last, then)
    assert STATES[last[0]][last[1]] is then


def test_a_finished_request_stays_finished() -> None:
    line = Session(LIBRARY, baud=9600, reply_timeout=0.5, report_limit=16)
    request = answered(line)
    for step in Step:
        with pytest.raises(KeyError):
            request.take(step)
    line.cancel(request)
    line.fail(TransportError("the line", "it was lost", "plug it in"))
    assert (request.reply, request.error) == (BatteryVoltage(7500), None)


def test_the_drawing_of_the_session_has_every_state_and_every_step() -> None:
    drawing = re.findall(r"\b[A-Z]{4,}\b", (session.__doc__ or "").partition("RequestQueue")[0])
    named = {each.name for each in [*State, *Step]}
    assert {word for word in drawing if word != "STATES"} == named


def test_a_request_cancelled_between_attempts_may_still_be_answered() -> None:
    line = Session(LIBRARY, baud=9600, reply_timeout=0.5, report_limit=16)
    request = tried_again(line)
    line.cancel(request)
    following = line.submit(BatteryVoltageRead())
    assert line.outgoing(1.0) == []
    answer(line, 1.01, 1)
    assert line.outgoing(1.01) == [BatteryVoltageRead().encode()]
    answer(line, 1.03, 2)
    assert following.reply == BatteryVoltage(2)
