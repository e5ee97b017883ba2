"""Both clients held to one promise: a test is told once, as a coroutine, and driven by each.

A client for threads is awaited as the one for asyncio is: each of its calls is done by the time
that it returns, so that nobody has to wait for it.
"""

from __future__ import annotations

import asyncio
import inspect
import time
from typing import TYPE_CHECKING, Any, TypeVar

import pytest
from busservo import AsyncController, AsyncMotion, Controller, Motion

from tests.lines.virtual_line import client, run
from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from collections.abc import AsyncIterator, Callable, Coroutine, Iterable

    from tests.lines.live_line import LiveLine
    from tests.lines.virtual_line import VirtualLine

    Work = Callable[[Any], Coroutine[Any, Any, None]]
    Talk = Callable[..., None]

_Result = TypeVar("_Result")


class Awaited:
    """A client for threads, or a motion, the calls of which are awaited as those of `like`."""

    def __init__(self, of: Controller | Motion) -> None:
        self._of = of
        self._like = AsyncMotion if isinstance(of, Motion) else AsyncController

    def __getattr__(self, name: str) -> Any:
        found, like = getattr(self._of, name), getattr(self._like, name, None)
        if inspect.isasyncgenfunction(like):
            return lambda *given, **more: _each(found(*given, **more))
        if inspect.iscoroutinefunction(like):
            return lambda *given, **more: _done(found, *given, **more)
        return found

    def __repr__(self) -> str:
        return repr(self._of)


async def _done(call: Callable[..., Any], *given: Any, **more: Any) -> Any:
    result = call(*given, **more)
    return Awaited(result) if isinstance(result, Motion) else result


async def _each(items: Iterable[Any]) -> AsyncIterator[Any]:
    for item in items:
        yield item


def done_at_once(work: Coroutine[Any, Any, _Result]) -> _Result:
    """Return the result of a coroutine that awaits nothing but calls of a client for threads."""
    try:
        work.send(None)
    except StopIteration as end:
        result: _Result = end.value
        return result
    raise AssertionError("it waits for something else than the client")


async def moment(client: Any) -> None:
    """Let a moment pass, in the way of a client."""
    if isinstance(client, Awaited):
        time.sleep(0.001)
    else:
        await asyncio.sleep(0.001)


def by_threads(line: VirtualLine, work: Work, **given: Any) -> None:
    with Controller(line, background=False, clock=line.clock, **given) as made:
        done_at_once(work(Awaited(made)))


def by_tasks(line: VirtualLine, work: Work, **given: Any) -> None:
    async def talk() -> None:
        async with client(line, **given) as made:
            await work(made)

    run(talk(), line)


def by_live_threads(line: LiveLine, work: Work, **given: Any) -> None:
    with Controller(line, **given) as made:
        done_at_once(work(Awaited(made)))


def by_live_tasks(line: LiveLine, work: Work, **given: Any) -> None:
    async def talk() -> None:
        async with AsyncController(line, **given) as made:
            await asyncio.wait_for(work(made), GENEROUS)

    asyncio.run(talk())


# In virtual time, and in real time, where threads read the line.
both = pytest.mark.parametrize("talk", [by_threads, by_tasks])
both_live = pytest.mark.parametrize("talk", [by_live_threads, by_live_tasks])
