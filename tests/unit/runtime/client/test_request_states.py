"""What a request goes through: each step of the table happens, and nothing else can."""

import re

import pytest
from busservo import BatteryVoltage, ServoMove, TransportError
from framewire.client import request
from framewire.client import session as session_module
from framewire.client.request import STATES, Request, State

from tests.in_turn import in_turn
from tests.lines.questions import IN_TIME, TRIP, answered, session
from tests.lines.stories import (
    QUESTION,
    Step,
    Told,
    ask,
    cancel,
    hear,
    replied,
    send,
    tick,
    told,
    want,
)

SEND, HOLD, DROP, RETRY, FINISH = (
    request.Step[name] for name in ("SEND", "HOLD", "DROP", "RETRY", "FINISH")
)
LOST = TransportError("the line", "it was lost", "plug it in")


def lose(it: Told) -> None:
    it.line.fail(LOST)


TOO_SOON, HEALTHY = hear(0.001, 7500), range(-20, -12)
KEEPS_ITS_RATE = [step for n in HEALTHY for step in (ask(n), hear(n + IN_TIME, 7500))]
LONG, FIRST, SECOND = (ServoMove(0, [(each, n) for each in range(n)]) for n in (80, 2, 3))
REPLACED = [want(LONG), send(0.0, LONG), want(FIRST, latest=True), want(SECOND, latest=True)]
# What happens, and the last step of the request in question: from which state to which.
STORIES: list[tuple[list[Step], State, request.Step, State]] = [
    ([ask()], State.WAITING, SEND, State.PENDING),
    (REPLACED, State.WAITING, FINISH, State.DONE),
    ([ask(), TOO_SOON], State.PENDING, HOLD, State.HELD),
    ([ask(retries=1), tick(1.0)], State.PENDING, RETRY, State.WAITING),
    ([ask(), tick(1.0)], State.PENDING, FINISH, State.DONE),
    ([ask(), TOO_SOON, hear(0.002, 7500)], State.HELD, HOLD, State.HELD),
    # One reply that is impossible, of a line that has kept its rate, is meant for another.
    ([*KEEPS_ITS_RATE, ask(), TOO_SOON, tick(TRIP + 0.25)], State.HELD, DROP, State.PENDING),
    ([ask(), TOO_SOON, hear(TRIP, 1)], State.PENDING, RETRY, State.WAITING),
    ([ask(), TOO_SOON, lose], State.HELD, FINISH, State.DONE),
    ([ask(), hear(IN_TIME, 7500)], State.HELD, FINISH, State.DONE),
]


def test_each_step_of_the_table_has_an_example() -> None:
    table = {(state, step) for state, steps in STATES.items() for step in steps}
    assert {(state, step) for _, state, step, _ in STORIES} == table


@in_turn("happens, state, step, then", lambda: STORIES)
def test_each_step_of_the_table_happens(
    happens: list[Step], state: State, step: request.Step, then: State
) -> None:
    taken: list[tuple[Request, State, request.Step]] = []
    take = Request.take

    def noted(of: Request, step: request.Step) -> None:
        taken.append((of, of.state, step))
        take(of, step)

    it = Told(session(reply_timeout=0.5))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Request, "take", noted)
        for each in happens:
            each(it)
    asked = it.requests[-2 if happens is REPLACED else -1]
    steps = [(before, step) for of, before, step in taken if of is asked]
    assert (steps[-1], asked.state) == ((state, step), then)
    assert STATES[state][step] is then


def test_a_finished_request_stays_finished() -> None:
    line = session()
    done = answered(line, 0.0, 7500)
    for step in request.Step:
        with pytest.raises(KeyError):
            done.take(step)
    line.cancel(done)
    line.fail(LOST)
    assert (done.reply, done.error) == (BatteryVoltage(7500), None)


def test_the_drawing_of_the_session_has_every_state_and_every_step() -> None:
    drawing = (session_module.__doc__ or "").partition("RequestQueue")[0]
    named = {each.name for each in [*State, *request.Step]}
    assert {*re.findall(r"\b[A-Z]{4,}\b", drawing)} - {"STATES"} == named


test_a_request = told(
    {
        "that is cancelled between attempts may still be answered": [
            *[ask(retries=1), tick(0.3), cancel(), want(), send(0.3)],
            *[hear(0.31, 1), send(0.31, QUESTION), hear(0.33, 2), replied(2)],
        ]
    }
)
