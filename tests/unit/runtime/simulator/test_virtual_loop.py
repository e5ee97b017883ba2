"""Virtual time: programs of asyncio on it, where it goes on while all wait; and its clock."""

from __future__ import annotations

import asyncio
import time
from contextlib import nullcontext
from typing import Any

import pytest
from busservo import ServoMove
from busservo_simulator import VirtualClock, VirtualController
from framewire.simulator.virtual_loop import VirtualLoop, run_virtual

from tests.in_turn import in_turn
from tests.lines.hosts import Host


def test_a_sleep_moves_the_clock_on_and_takes_no_time() -> None:
    clock = VirtualClock()
    woken: list[tuple[str, float]] = []

    async def sleep(name: str, seconds: float) -> None:
        await asyncio.sleep(seconds)
        woken.append((name, clock.now()))

    async def main() -> str:
        await asyncio.gather(sleep("late", 86_400), sleep("soon", 0.5), sleep("at once", 0))
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(asyncio.sleep(20), 10)
        return "done"

    assert run_virtual(main(), clock) == "done"
    assert woken == [("at once", 0.0), ("soon", 0.5), ("late", 86_400.0)]
    assert clock.now() == 86_410.0


def test_time_stands_still_while_a_thread_works() -> None:
    clock = VirtualClock()

    async def main() -> None:
        alarm = asyncio.ensure_future(asyncio.sleep(1))
        await asyncio.to_thread(time.sleep, 0.05)
        assert clock.now() == 0
        await alarm

    run_virtual(main(), clock)
    assert clock.now() == 1


@in_turn(
    "last, error",
    lambda: [
        (lambda: asyncio.sleep(1), None),
        (lambda: asyncio.Event().wait(), "every task waits, and for nothing that will ever"),
    ],
)
def test_what_still_waits_at_the_end_is_cancelled(last: Any, error: str | None) -> None:
    ended: list[str] = []

    async def until_cancelled(waiting: Any) -> None:
        try:
            await waiting
        finally:
            ended.append("ended")

    async def main() -> None:
        other = asyncio.sleep(100) if error is None else asyncio.Event().wait()
        asyncio.ensure_future(until_cancelled(other))  # noqa: RUF006 - it is to be left behind
        await until_cancelled(last())

    clock = VirtualClock()
    with pytest.raises(RuntimeError, match=error) if error else nullcontext():
        run_virtual(main(), clock)
    assert ended == ["ended"] * 2
    assert clock.now() == (0 if error else 1)


def test_a_board_that_is_gone_no_longer_moves_the_time() -> None:
    clock = VirtualClock()
    with VirtualController(clock=clock) as board:
        board.spurious_output(b"x")
    loop = VirtualLoop(clock)  # which may be made by hand
    loop.run_until_complete(asyncio.sleep(10))
    assert loop.time() == loop.clock.now() == 10
    loop.close()


# -------------------------------------------------------------------- the clock
def test_time_does_not_go_back() -> None:
    clock = VirtualClock()
    for seconds in (-1, float("nan")):
        with pytest.raises(ValueError, match=f"not by {seconds}"):
            clock.advance(seconds)
    clock.move_to(2)
    clock.move_to(1)
    assert clock.now() == 2


def test_real_time_cannot_be_moved() -> None:
    with VirtualController() as board, pytest.raises(TypeError, match="VirtualClock"):
        board.advance(1)


def test_a_host_that_waits_moves_no_clock_that_is_moved_by_hand() -> None:
    with VirtualController(clock=VirtualClock()) as board:
        host = Host(board.transport)
        host.say(ServoMove(1000, [(1, 900)]))
        assert host.receive(0.01) is None
        assert board.servos[1].position == 500
        board.advance(0.25)
        assert board.servos[1].position == 600
