"""Devices that share a line: whose reply is whose, one that is dead, all at once; and both ends."""

import asyncio
from contextlib import suppress
from typing import Any, TypeAlias

import lxservo
import pytest
from framewire.simulator.virtual_loop import run_virtual
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import library, library_of
from tests.lines.servo_bus import READ_ID, READ_POSITION, ServoBus, frame
from tests.lines.timed_line import ScriptedLine, client_on
from tests.protocols.specs import FILES

# Which servo is asked; after how many seconds it answers, and how often.
Turn: TypeAlias = tuple[int, float, int]

# A question and its reply on the wire, with what a servo takes to begin.
TRIP = 14 * 10 / 115200 + 0.001


def client(line: ServoBus, **settings: Any) -> Any:
    return client_on(line, lxservo.Controller, **settings)


def took(line: ServoBus, call: Any) -> float:
    began = line.clock()
    call()
    return float(line.clock() - began)


# ------------------------------------------------------------------ one device of many
def test_a_device_has_each_method_that_is_for_one() -> None:
    named = {name for name in vars(lxservo.Controller) if not name.startswith("_")}
    for kind in (lxservo.OneDevice, lxservo.AllDevices):
        own = {name for name in vars(kind) if not name.startswith("_")} - {"address"}
        assert own == named - {"device", "broadcast", "gather"}


# ------------------------------------------------------------------ a dead servo
def test_a_dead_servo_delays_no_question_to_another() -> None:
    line = ServoBus(1, 2, 3)
    line.servos[2].dead = True
    with client(line) as bus:
        for _ in range(5):
            with pytest.raises(lxservo.NoReplyError):
                bus.read_position(2)
            assert took(line, lambda: bus.read_position(1)) < 3 * TRIP
            assert took(line, lambda: bus.read_position(3)) < 3 * TRIP
        with pytest.raises(lxservo.NoReplyError, match="to 3 requests"):
            bus.request(lxservo.PositionRead(2), retries=2)


def test_others_are_asked_while_a_dead_servo_is_still_waited_for() -> None:
    line = ServoBus(1, 2, 3)

    async def ask() -> float:
        async with client_on(line, lxservo.AsyncController) as bus:
            for number in (1, 2, 3):
                await bus.device(number).read_position()
            line.servos[2].dead = True
            began = line.clock()
            dead = asyncio.ensure_future(bus.read_position(servo_id=2))
            await asyncio.sleep(0)
            assert await bus.read_position(servo_id=3) == 3002
            assert await bus.read_position(servo_id=1) == 1002
            await bus.device(3).move(500, 20)
            ended = line.clock()
            with pytest.raises(lxservo.NoReplyError):
                await dead
        return float(ended - began)

    assert run_virtual(ask(), line.timer) < 0.1
    assert line.collisions == 0


def test_nothing_is_sent_while_a_servo_may_answer() -> None:
    line = ServoBus(1, 2)

    async def ask() -> None:
        async with client_on(line, lxservo.AsyncController) as bus:
            for _ in range(20):
                asked = [asyncio.ensure_future(bus.read_position(each)) for each in (1, 2)]
                await asyncio.sleep(0.0015)  # now the first begins to answer
                await bus.move(1, position=500, time_ms=10)
                await asyncio.gather(*asked)

    run_virtual(ask(), line.timer)
    assert line.collisions == 0
    assert len(line.servos[1].moves) == 20


# ------------------------------------------------------------------ all at once
def test_nobody_is_awaited_who_never_answers() -> None:
    line = ServoBus(1, 2)
    with client(line) as bus:
        problem = r"servo_id: 254 \(all\) is answered by nobody"
        with pytest.raises(lxservo.EncodeError, match=problem):
            bus.read_position(254)
        with pytest.raises(lxservo.EncodeError, match=r"`broadcast\(\)`"):
            bus.request(lxservo.PositionRead(254))
        assert line.commands == []


def test_a_question_to_all_gathers_who_answers_in_time() -> None:
    line = ServoBus(1, 2, 3)
    line.servos[2].dead = True
    with client(line) as bus:
        there = bus.broadcast().read_servo_id(within=0.05)
        assert [(each.servo_id, each.own_id) for each in there] == [(1, 1), (3, 3)]
        assert bus.broadcast().read_servo_id(within=0) == []
        for wrong in (-1, float("inf"), float("nan")):
            with pytest.raises(ValueError, match="must be 0 seconds or more, and not endless"):
                bus.broadcast().read_servo_id(within=wrong)


def test_who_answers_all_too_late_does_not_answer_what_is_asked_next() -> None:
    line = ServoBus(1)
    with client(line) as bus:
        line.servos[1].delay = 0.06
        assert bus.broadcast().read_servo_id(within=0.05) == []
        line.servos[1].delay = 0.001
        assert bus.read_servo_id(1) == 1
        assert bus.counters.unsolicited == 1


# ------------------------------------------------------------------ each with its faults

TIMEOUT = 0.05
# No question takes longer: it may wait for a late reply, and is then asked three times itself.
BOUND = 4 * (TIMEOUT + TRIP)
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


@given(st.lists(st.lists(st.sampled_from(NUMBERS), min_size=1, max_size=6), max_size=8), TURNS)
def test_many_tasks_each_have_their_own_answer(rounds: list[list[int]], turns: list[Turn]) -> None:
    line = ServoBus(*NUMBERS, apart=False)
    given_out: list[int] = []

    async def ask(bus: lxservo.AsyncController, number: int) -> None:
        told, began = len(line.servos[number].told), line.clock()
        with suppress(lxservo.NoReplyError):
            given_out.append(await bus.read_position(number))
            assert given_out[-1] in line.servos[number].told[told:]
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


# ------------------------------------------------------------------ the other end
def servos(*addresses: int) -> Any:
    """Return a device that answers two questions, and keeps what it is called for."""

    class Servos(lxservo.Device):
        def __init__(self) -> None:
            super().__init__(*addresses)
            self.called: list[Any] = []

        def on_position_read(self, message: Any) -> Any:
            self.called.append(message)
            return lxservo.Position(message.servo_id, position=message.servo_id)

        def on_servo_id_read(self, message: Any) -> Any:
            for each in sorted(self.addresses) if message.servo_id == 254 else ():
                self.send(lxservo.ServoId(each, own_id=each))
            return lxservo.ServoId(message.servo_id, own_id=message.servo_id)

    return Servos()


def test_a_device_answers_only_where_its_own_address_is_called() -> None:
    device = servos(1, 2)
    assert device.receive(frame(3, READ_POSITION)) == b""
    assert device.called == []
    assert device.receive(frame(2, READ_POSITION)) == frame(2, READ_POSITION, 2, 0)
    assert device.receive(frame(1, READ_POSITION)) == frame(1, READ_POSITION, 1, 0)
    # One without an address answers to any.
    assert servos().receive(frame(7, READ_POSITION)) == frame(7, READ_POSITION, 7, 0)


def test_what_is_for_all_is_handled_and_only_answered_by_who_says_so() -> None:
    device = servos(1, 2)
    assert device.receive(frame(254, READ_POSITION)) == b""
    assert [message.servo_id for message in device.called] == [254]
    # Its handler sends, and what it returns is not sent.
    assert device.receive(frame(254, READ_ID)) == frame(1, READ_ID, 1) + frame(2, READ_ID, 2)


def test_a_client_numbers_its_frames() -> None:
    with library(library_of(FILES["mavlink1"])) as made:
        mavlink: Any = made
        line = ScriptedLine(lambda _: b"")
        named = {"target_system": 1, "target_component": 1, "name": ""}
        question = mavlink.ParameterRead(1, index=2, **named, sequence=9)
        with client_on(line, mavlink.Controller, settle=None) as ground:
            for _ in range(300):
                ground.send(question)
        sent = [mavlink.decode(each, question.DIRECTION).sequence for each in line.written]
        assert sent == [each % 256 for each in range(300)]
