"""No wrong value over pseudo-terminals, TCP and memory, in real time."""

import asyncio
import math
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import AbstractAsyncContextManager, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from busservo import AsyncController, Controller, open_async_controller, open_controller
from busservo_simulator import Faults, VirtualController

from tests import soak
from tests.lines.at_once import at_once
from tests.lines.boards import no_board_refuses_anything
from tests.lines.both_clients import Awaited, done_at_once
from tests.lines.conversation import (
    FAULTS,
    Ledger,
    converse,
    converse_async,
    reports_received,
    reports_received_async,
)
from tests.timeouts import Line

__all__ = ["no_board_refuses_anything"]

WAYS = ["memory", "tcp"] if sys.platform == "win32" else ["memory", "tcp", "pty"]
# As if on a slow machine, where an answer takes its time; each lost one costs twice as much.
LIVE_REPLY_TIMEOUT = 0.5


@contextmanager
def board_at(way: str, folder: Path, faults: Faults) -> Iterator[tuple[VirtualController, Ledger]]:
    folder.mkdir(exist_ok=True)
    link = folder / "board" if way == "pty" else None
    with VirtualController(way, faults=faults, link=link) as board:  # type: ignore[arg-type]
        yield board, Ledger(board)


def line_at(way: str) -> Line:
    """Return the client's settings: a line that takes no time, as it does; over TCP, a slow one."""
    baud = 9600 if way == "tcp" else math.inf
    return {"reply_timeout": LIVE_REPLY_TIMEOUT, "baud": baud, "settle": 0}


def opened(board: VirtualController, way: str) -> Controller:
    if way == "memory":
        return Controller(board.transport, **line_at(way))
    return open_controller(board.port, **line_at(way))


def opened_async(
    board: VirtualController, way: str
) -> AbstractAsyncContextManager[AsyncController]:
    if way == "memory":
        return AsyncController(board.transport, **line_at(way))
    return open_async_controller(board.port, **line_at(way))


LINES = [(way, kind) for way in WAYS for kind in FAULTS]
# With each of them, the line is cut once or twice, or one reply is lost, or none over TCP, where
# the client doubts most replies: each of these costs the better part of a second.
SEEDS = {"memory": (6, 5), "tcp": (2, 2), "pty": (6, 5)}


def faults_at(way: str, kind: str) -> Faults:
    mixed, cut = SEEDS[way]
    return replace(FAULTS[kind], seed=cut if kind == "cut" else mixed)


async def talk(controller: Any, ledger: Ledger, kind: str, seed: int) -> None:
    await converse_async(controller, ledger, seed, 12)
    if kind == "mixed":
        assert await reports_received_async(controller, ledger) == ledger.reported
    assert controller.counters.lost_reports == 0


def by_threads(board: VirtualController, way: str, *talked: Any) -> None:
    with opened(board, way) as controller:
        done_at_once(talk(Awaited(controller), *talked))


def by_tasks(board: VirtualController, way: str, *talked: Any) -> None:
    async def work() -> None:
        async with opened_async(board, way) as controller:
            await talk(controller, *talked)

    asyncio.run(work())


@pytest.mark.parametrize("clients", [by_threads, by_tasks])
def test_answers_and_reports_are_right_over_a_live_line(
    clients: Callable[..., None], tmp_path: Path
) -> None:
    def held(way: str, kind: str) -> None:
        faults = faults_at(way, kind)
        with board_at(way, tmp_path / kind, faults) as (board, ledger):
            clients(board, way, ledger, kind, faults.seed)
            assert ledger.right >= 3
            assert (ledger.reconnected > 0) == (kind == "cut")

    at_once(held, LINES)


def test_eight_threads_share_a_line_with_faults(tmp_path: Path) -> None:
    def held(way: str, kind: str) -> None:
        seed = {"memory": 6, "tcp": 8, "pty": 2}[way]
        with board_at(way, tmp_path, replace(FAULTS[kind], seed=seed)) as (board, ledger):
            with opened(board, way) as controller, ThreadPoolExecutor(8) as pool:
                list(pool.map(lambda seed: converse(controller, ledger, seed, 3), range(8)))
                assert reports_received(controller, ledger) == ledger.reported
            assert ledger.right >= 5

    at_once(held, [(way, "mixed") for way in WAYS])


def test_the_soak_runs(capsys: pytest.CaptureFixture[str]) -> None:
    """In short; `make soak` asks a hundred thousand times."""
    soak.main(["--requests", "200", "--rounds", "2"])
    assert capsys.readouterr().out.count(" 0 lost") == 5
