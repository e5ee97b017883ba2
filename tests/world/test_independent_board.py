"""The independent board at a pty and over TCP, in real time: threads, tasks, and cancellation.

Frames take their time at 9600 baud both ways, and every fifth reply meets a fault. No answer is
lost or torn here, so that no call has to wait for its time to be over, on however slow a machine.
"""

import asyncio
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from random import Random

import pytest
from busservo import AsyncController, Controller, open_async_controller, open_controller

from tests.contract.independent import faults, firmware
from tests.contract.independent.board import Board
from tests.contract.independent.conversation import SIX, Conversation, Requested, repeated
from tests.contract.independent.faults import Script
from tests.contract.independent.ports import Port, PtyPort, TcpPort
from tests.lines.at_once import at_once
from tests.timeouts import GENEROUS, await_that

PORTS = [TcpPort] if sys.platform == "win32" else [PtyPort, TcpPort]
BAUD = 9600
# The other end is a thread of the same busy machine.
REPLY_TIMEOUT = 5.0
REPORT = firmware.report(firmware.COMPLETED, 8, 1)
SCRIPTS = [
    faults.duplicated(),
    faults.duplicated(0.004),
    faults.late(0.03),
    faults.preceded(b"\x55\x00\xff"),
    faults.preceded(REPORT, is_report=True),
    faults.followed(REPORT, 0.003, is_report=True),
]


def scripts(seed: int) -> Board:
    """Return scripts with a fault for every fifth reply."""
    random = Random(seed)  # noqa: S311 - to be repeated

    def script(number: int) -> Script | None:
        return random.choice(SCRIPTS) if number % 5 == 0 else None

    return Board(baud=BAUD, gathers=True, thinks=0.002, faults=script)


def settle(board: Board, controller: Controller | AsyncController) -> bool:
    """Return whether all reports have come, and been counted."""
    counters = controller.counters
    replies = [said for said in board.said if said.data[:2] == b"UU" and said.data[3] in (15, 21)]
    return len(replies) <= counters.replies + counters.unsolicited


def check(
    board: Board, controller: Controller | AsyncController, talks: list[Conversation]
) -> None:
    """Check what holds on however slow a machine.

    A host that is held up reads a reply late, and then cannot know that it had come too soon:
    exactly which call may be stale is tested in virtual time.
    """
    calls = [call for talk in talks for call in talk.calls]
    assert max(call.ended - call.began for call in calls) < GENEROUS
    assert {call.number for call in calls if call.number} <= set(range(1, board.questions + 1))
    wrong = sum(len(talk.stale) + len(talk.failed) for talk in talks) + repeated(talks)
    assert wrong <= 2 * controller.counters.unsolicited
    assert board.refused == []


def turns(seed: int, count: int) -> list[Requested]:
    """Return the calls; each twice in a row, so that their replies could be confused."""
    random = Random(seed)  # noqa: S311 - to be repeated
    kinds: list[Requested] = [None, None, (3,), (1, 2), SIX]
    pairs = ([random.choice(kinds)] * 2 for _ in range((count + 1) // 2))
    return [requested for pair in pairs for requested in pair][:count]


def ask_all(talk: Conversation, controller: Controller, seed: int, count: int) -> None:
    for requested in turns(seed, count):
        talk.ask(controller, requested)


async def ask_all_async(
    talk: Conversation, controller: AsyncController, seed: int, count: int
) -> None:
    for requested in turns(seed, count):
        await talk.ask_async(controller, requested)


@pytest.mark.parametrize(("threads", "count"), [(1, 20), (8, 4)])
def test_threads_get_right_answers(threads: int, count: int) -> None:
    def talk_at(port: type[Port]) -> None:
        with (
            port(scripts(threads)) as end,
            open_controller(end.name, reply_timeout=REPLY_TIMEOUT, settle=0) as controller,
        ):
            talks = [Conversation(end.board, time.monotonic) for _ in range(threads)]
            with ThreadPoolExecutor(threads) as pool:
                each = enumerate(talks, 1)
                list(pool.map(lambda item: ask_all(item[1], controller, item[0], count), each))
            await_that(lambda: settle(end.board, controller))
            check(end.board, controller, talks)
            assert controller.read_battery_voltage() == end.board.questions
            await_that(lambda: controller.counters.reports >= len(end.board.reported))
            received = [each.encode() for each in controller.reports(timeout=0.05)]
            assert received == end.board.reported

    at_once(talk_at, [(port,) for port in PORTS])


def test_one_task_and_twenty_more_get_right_answers() -> None:
    def talk_at(port: type[Port]) -> None:
        with port(scripts(3)) as end:

            async def work() -> None:
                async with open_async_controller(
                    end.name, reply_timeout=REPLY_TIMEOUT, settle=0
                ) as controller:
                    talks = [Conversation(end.board, time.monotonic) for _ in range(21)]
                    await ask_all_async(talks[0], controller, 0, 10)
                    each = enumerate(talks[1:])
                    await asyncio.gather(
                        *(ask_all_async(talk, controller, n, 1) for n, talk in each)
                    )
                    while not settle(end.board, controller):
                        await asyncio.sleep(0.001)
                    check(end.board, controller, talks)
                    assert await controller.read_battery_voltage() == end.board.questions
                    while controller.counters.reports < len(end.board.reported):
                        await asyncio.sleep(0.001)
                    received = [each.encode() async for each in controller.reports(timeout=0.05)]
                    assert received == end.board.reported

            asyncio.run(asyncio.wait_for(work(), GENEROUS))

    at_once(talk_at, [(port,) for port in PORTS])


@pytest.mark.parametrize("port", PORTS)
def test_a_cancelled_request_leaves_no_reply_to_the_next(port: type[Port]) -> None:
    """A read is given up while its question is on the wire, or its reply."""
    with port(Board(baud=BAUD, gathers=True, thinks=0.002)) as end:

        async def work() -> None:
            async with open_async_controller(
                end.name, reply_timeout=REPLY_TIMEOUT, settle=0
            ) as controller:
                talk = Conversation(end.board, time.monotonic)
                for wait in (0.0, 0.001, 0.003, 0.006, 0.009, 0.012):
                    given_up = asyncio.ensure_future(controller.read_battery_voltage())
                    await asyncio.sleep(wait)
                    given_up.cancel()
                    await asyncio.gather(given_up, return_exceptions=True)
                    await talk.ask_async(controller, None)
                assert (talk.stale, talk.failed) == ([], [])

        asyncio.run(asyncio.wait_for(work(), GENEROUS))


@pytest.mark.parametrize("port", PORTS)
def test_a_reply_meant_for_a_killed_program_is_dropped(port: type[Port]) -> None:
    """5000 mV for 7401: the answer to its question came 10 ms after we opened the port."""
    with port(Board(baud=BAUD, gathers=True, faults={1: faults.late(0.004)}.get)) as end:
        end.receive(firmware.battery_question())
        await_that(lambda: end.board.questions)
        with open_controller(end.name, reply_timeout=REPLY_TIMEOUT) as controller:
            assert controller.read_battery_voltage() == 2
