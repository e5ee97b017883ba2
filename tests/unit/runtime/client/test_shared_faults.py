"""Servos on one wire, each with its faults: no value goes to another question, or twice."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING

import lxservo
from busservo_simulator.virtual_loop import run_virtual
from hypothesis import given
from hypothesis import strategies as st

from tests.lines.servo_bus import ServoBus
from tests.lines.timed_line import client_on

if TYPE_CHECKING:
    from typing import TypeAlias

    # Which servo is asked; after how many seconds it answers, and how often.
    Turn: TypeAlias = tuple[int, float, int]

TIMEOUT = 0.05
# No question takes longer: it may wait for a late reply, and is then awaited itself.
BOUND = 4 * TIMEOUT
NUMBERS = (1, 2, 3)
# After so many rounds it is known that the line keeps its rate, and so what comes too early.
ENOUGH = 3

# As late as this can be told: what comes later than twice its time looks like the next answer.
DELAYS = st.sampled_from([0.0005, 0.002, 0.02, 0.04, 0.06, 0.09])
TURNS = st.lists(st.tuples(st.sampled_from(NUMBERS), DELAYS, st.integers(0, 2)), max_size=30)


def prepared(line: ServoBus, turn: Turn) -> None:
    number, delay, copies = turn
    servo = line.servos[number]
    servo.delay, servo.copies, servo.dead = delay, copies, not copies


@given(TURNS)
def test_each_value_is_the_answer_to_its_own_question(turns: list[Turn]) -> None:
    line = ServoBus(*NUMBERS, apart=False)
    with client_on(line, lxservo.Controller, reply_timeout=TIMEOUT) as bus:
        for number in NUMBERS * ENOUGH:
            bus.read_position(number)
        for turn in turns:
            prepared(line, turn)
            number = turn[0]
            told, began = len(line.servos[number].told), line.clock()
            try:
                value = bus.read_position(number)
            except lxservo.NoReplyError:
                pass
            else:
                assert value in line.servos[number].told[told:]
            assert line.clock() - began < BOUND


@given(st.lists(st.lists(st.sampled_from(NUMBERS), min_size=1, max_size=6), max_size=8), TURNS)
def test_many_tasks_each_have_their_own_answer(rounds: list[list[int]], turns: list[Turn]) -> None:
    line = ServoBus(*NUMBERS, apart=False)
    given_out: list[int] = []

    async def ask(bus: lxservo.AsyncController, number: int) -> None:
        told, began = len(line.servos[number].told), line.clock()
        try:
            value = await bus.read_position(number)
        except lxservo.NoReplyError:
            pass
        else:
            assert value in line.servos[number].told[told:]
            given_out.append(value)
        assert line.clock() - began < 6 * BOUND

    async def converse() -> None:
        async with client_on(line, lxservo.AsyncController, reply_timeout=TIMEOUT) as bus:
            for number in NUMBERS * ENOUGH:
                await bus.read_position(number)
            for numbers in rounds:
                for turn in turns[: len(NUMBERS)]:
                    prepared(line, turn)
                await asyncio.gather(*(ask(bus, number) for number in numbers))
                await bus.move(1, position=500, time_ms=10)

    run_virtual(converse(), line.timer)
    assert len(given_out) == len({*given_out}), "an answer was given to two"
