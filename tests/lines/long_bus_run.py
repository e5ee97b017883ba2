"""A long run on a bus of servos, one of them dead, the others late at times or telling twice."""

import asyncio
from random import Random

import lxservo
from framewire.simulator.virtual_loop import run_virtual

from tests.lines.growth import Growth
from tests.lines.servo_bus import ServoBus
from tests.lines.timed_line import client_on

NUMBERS = (1, 2, 3, 4, 5)
DEAD = 3
TIMEOUT = 0.05
# Late replies among them, though none that is later than twice its time.
DELAYS = (0.0005, 0.0005, 0.001, 0.002, 0.02, 0.06)
COPIES = (0, 1, 1, 1, 1, 2)
TASKS = 20


def on_a_bus(requests: int, rounds: int, seed: int) -> None:
    """Ask, by many tasks. Raises AssertionError at the first thing that is wrong."""
    line, random = ServoBus(*NUMBERS, apart=False), Random(seed)  # noqa: S311 - to be repeated
    line.servos[DEAD].dead = True
    growth = Growth(f"a bus of {len(NUMBERS)}")

    async def ask(bus: lxservo.AsyncController, number: int) -> None:
        servo = line.servos[number]
        if number != DEAD:
            servo.delay, servo.copies = random.choice(DELAYS), random.choice(COPIES)
            servo.dead = not servo.copies
        told = len(servo.told)
        try:
            value = await bus.read_position(number)
        except lxservo.NoReplyError:
            return
        assert value in servo.told[told:]

    async def converse() -> int:
        async with client_on(line, lxservo.AsyncController, reply_timeout=TIMEOUT) as bus:
            for number in NUMBERS * 4:
                await ask(bus, number)
            for turn in range(rounds):
                for _ in range(requests // rounds // TASKS):
                    await asyncio.gather(*(ask(bus, random.choice(NUMBERS)) for _ in range(TASKS)))
                    await bus.broadcast().start_move()
                line.commands.clear()
                for servo in line.servos.values():
                    servo.told.clear()
                assert len(bus._session._matcher.late) < TASKS
                assert not bus._session._matcher.pending
                growth.round((turn + 1) * requests // rounds)
            return int(bus.counters.replies)

    answered = run_virtual(converse(), line.timer)
    growth.end(requests, f"{answered} answered rightly")
