"""Both clients held to one promise: a test is told once, as a coroutine, and driven by each.

A client for threads is awaited as the one for asyncio is: each of its calls is done by the time
that it returns, so that nobody has to wait for it.
"""

import asyncio
import inspect
import time
from collections.abc import AsyncIterator, Callable, Coroutine, Iterable
from functools import wraps
from typing import Any, TypeVar

import busservo
import pytest
from busservo import AsyncController, AsyncMotion, Controller, Motion, open_async_controller

from tests.lines.live_line import LiveLine
from tests.lines.receiving import unanswered
from tests.lines.virtual_line import VirtualLine, client, run
from tests.timeouts import GENEROUS

Work = Callable[[Any], Coroutine[Any, Any, None]]
Talk = Callable[..., None]
Told = Callable[..., Coroutine[Any, Any, None]]

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


async def until(client: Any, true: Callable[[], object]) -> None:
    """Let moments pass until a condition holds; fail if it takes too long."""
    end = time.monotonic() + GENEROUS
    while not true():
        assert time.monotonic() < end, "it has not come true"
        await moment(client)


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


def by_threads_at(port: str, work: Work, **given: Any) -> None:
    with busservo.open_controller(port, **given) as made:
        done_at_once(work(Awaited(made)))


def by_tasks_at(port: str, work: Work, **given: Any) -> None:
    async def talk() -> None:
        async with open_async_controller(port, **given) as made:
            await work(made)

    asyncio.run(talk())


# In virtual time; in real time, where threads read the line; and at a port.
TALKS: list[Talk] = [by_threads, by_tasks]
LIVE_TALKS: list[Talk] = [by_live_threads, by_live_tasks]
PORT_TALKS: list[Talk] = [by_threads_at, by_tasks_at]


def both(answer: Any = unanswered, **given: Any) -> Callable[[Told], Callable[..., None]]:
    """Drive a test with each client, in virtual time: a coroutine of its `controller` and `line`.

    The line answers so, and the client is made with what is given.
    """
    return _driven(TALKS, lambda: VirtualLine(answer), given)


def both_live(
    line: Callable[[], LiveLine] = LiveLine, **given: Any
) -> Callable[[Told], Callable[..., None]]:
    """Drive a test likewise in real time, on a line that is made so."""
    return _driven(LIVE_TALKS, line, given)


def _driven(
    talks: list[Talk], make: Callable[[], Any], given: dict[str, Any]
) -> Callable[[Told], Callable[..., None]]:
    def decorated(test: Told) -> Callable[..., None]:
        named = inspect.signature(test).parameters

        @wraps(test)
        def driven(talk: Talk, **fixtures: Any) -> None:
            made = make()
            own = {"line": made} if "line" in named else {}
            talk(made, lambda controller: test(controller=controller, **own, **fixtures), **given)

        kept = [each for name, each in named.items() if name not in ("controller", "line")]
        ours = inspect.Parameter("talk", inspect.Parameter.POSITIONAL_OR_KEYWORD)
        driven.__signature__ = inspect.Signature([ours, *kept])  # type: ignore[attr-defined]
        parametrized: Callable[..., None] = pytest.mark.parametrize("talk", talks)(driven)
        return parametrized

    return decorated
