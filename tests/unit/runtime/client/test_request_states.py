"""What a request goes through: each step of the table happens, and nothing else can."""

import re
from collections.abc import Callable

import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, ServoMove, TransportError
from framewire.client import session as session_module
from framewire.client.request import STATES, Request, State, Step
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines.questions import IN_TIME, TRIP, answered, ask, say, session

Do = Callable[[Session], object]

LOST = TransportError("the line", "it was lost", "plug it in")


def asked_again(line: Session) -> Request:
    return ask(line, retries=1)


def asked_on_a_line_that_keeps_its_rate(line: Session) -> Request:
    for number in range(8):
        answered(line, number - 20.0, 7500)
    return ask(line)


def replaced(line: Session) -> Request:
    line.submit(ServoMove(0, [(each, 0) for each in range(80)]), latest=True)
    line.outgoing(0.0)
    request = line.submit(ServoMove(0, [(1, 1)]), latest=True)
    line.submit(ServoMove(0, [(1, 2)]), latest=True)
    return request


def hear(at: float, voltage: int = 7500) -> Do:
    return lambda line: say(line, at, voltage)


def tick(at: float) -> Do:
    return lambda line: line.tick(at)


def lose(line: Session) -> None:
    line.fail(LOST)


# How a request begins, what happens then, and the last step of it: from which state to which.
TOO_SOON = hear(0.001)
STORIES: list[tuple[Callable[[Session], Request], list[Do], State, Step, State]] = [
    (ask, [], State.WAITING, Step.SEND, State.PENDING),
    (replaced, [], State.WAITING, Step.FINISH, State.DONE),
    (ask, [TOO_SOON], State.PENDING, Step.HOLD, State.HELD),
    (asked_again, [tick(1.0)], State.PENDING, Step.RETRY, State.WAITING),
    (ask, [tick(1.0)], State.PENDING, Step.FINISH, State.DONE),
    (ask, [TOO_SOON, hear(0.002)], State.HELD, Step.HOLD, State.HELD),
    # One reply that is impossible, of a line that has kept its rate, is meant for another.
    (
        asked_on_a_line_that_keeps_its_rate,
        [TOO_SOON, tick(TRIP + 0.25)],
        State.HELD,
        Step.DROP,
        State.PENDING,
    ),
    (ask, [TOO_SOON, hear(TRIP, 1)], State.PENDING, Step.RETRY, State.WAITING),
    (ask, [TOO_SOON, lose], State.HELD, Step.FINISH, State.DONE),
    (ask, [hear(IN_TIME)], State.HELD, Step.FINISH, State.DONE),
]


def test_each_step_of_the_table_has_an_example() -> None:
    table = {(state, step) for state, steps in STATES.items() for step in steps}
    assert {(state, step) for _, _, state, step, _ in STORIES} == table


@in_turn("begin, happens, state, step, then", lambda: STORIES)
def test_each_step_of_the_table_happens(
    begin: Callable[[Session], Request], happens: list[Do], state: State, step: Step, then: State
) -> None:
    taken: list[tuple[Request, State, Step]] = []
    take = Request.take

    def noted(request: Request, step: Step) -> None:
        taken.append((request, request.state, step))
        take(request, step)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Request, "take", noted)
        line = session(reply_timeout=0.5)
        request = begin(line)
        for each in happens:
            each(line)
    steps = [(before, step) for each, before, step in taken if each is request]
    assert (steps[-1], request.state) == ((state, step), then)
    assert STATES[state][step] is then


def test_a_finished_request_stays_finished() -> None:
    line = session()
    request = answered(line, 0.0, 7500)
    for step in Step:
        with pytest.raises(KeyError):
            request.take(step)
    line.cancel(request)
    line.fail(LOST)
    assert (request.reply, request.error) == (BatteryVoltage(7500), None)


def test_the_drawing_of_the_session_has_every_state_and_every_step() -> None:
    drawing = (session_module.__doc__ or "").partition("RequestQueue")[0]
    named = {each.name for each in [*State, *Step]}
    assert {*re.findall(r"\b[A-Z]{4,}\b", drawing)} - {"STATES"} == named


def test_a_request_cancelled_between_attempts_may_still_be_answered() -> None:
    line = session()
    request = asked_again(line)
    line.tick(0.3)
    line.cancel(request)
    following = line.submit(BatteryVoltageRead())
    assert line.outgoing(0.3) == []
    say(line, 0.31, 1)
    assert line.outgoing(0.31) == [BatteryVoltageRead().encode()]
    say(line, 0.33, 2)
    assert following.reply == BatteryVoltage(2)
