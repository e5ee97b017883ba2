"""An event loop on virtual time: when every task waits, the clock moves on, and nobody sleeps."""

from __future__ import annotations

import asyncio
import selectors
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine
    from concurrent.futures import Executor

    from typing_extensions import TypeVarTuple, Unpack

    from .clock import VirtualClock

    _Arguments = TypeVarTuple("_Arguments")

_Result = TypeVar("_Result")
_SHORTEST = 1e-6


def run_virtual(main: Coroutine[Any, Any, _Result], clock: VirtualClock) -> _Result:
    """Run a coroutine as `asyncio.run` does, in a loop whose time is that of `clock`.

    Raises RuntimeError where every task waits, and for nothing that will ever happen.
    """
    loop = VirtualLoop(clock)
    try:
        return loop.run_until_complete(main)
    finally:
        try:
            loop.run_until_complete(_cancel_others())
            loop.run_until_complete(loop.shutdown_asyncgens())
            loop.run_until_complete(loop.shutdown_default_executor())
        finally:
            loop.close()


class VirtualLoop(asyncio.SelectorEventLoop):
    """A loop whose `time()` is that of a VirtualClock.

    While every task waits, time goes on to the next timer, or to the next event of a board that
    lives by the same clock. While a thread of an executor is at work, time stands still.
    """

    def __init__(self, clock: VirtualClock) -> None:
        self.clock = clock
        self._waits = _Waits(clock)
        super().__init__(self._waits)

    def time(self) -> float:
        """Return the time of the clock."""
        return self.clock.now()

    def run_in_executor(
        self,
        executor: Executor | None,
        func: Callable[[Unpack[_Arguments]], _Result],
        *args: Unpack[_Arguments],
    ) -> asyncio.Future[_Result]:
        """Call a function in a thread, during which time stands still."""
        future = super().run_in_executor(executor, func, *args)
        self._waits.threads += 1
        future.add_done_callback(self._thread_is_done)
        return future

    async def shutdown_default_executor(self, timeout: float | None = None) -> None:  # noqa: ARG002
        """End the threads of the executor."""
        self._waits.threads += 1
        try:
            await super().shutdown_default_executor()
        finally:
            self._waits.threads -= 1

    def _thread_is_done(self, _: object) -> None:
        self._waits.threads -= 1


class _Waits(selectors.DefaultSelector):
    """What a loop waits by: it moves the clock on instead."""

    def __init__(self, clock: VirtualClock) -> None:
        super().__init__()
        self._clock = clock
        # How many are at work that will wake the loop.
        self.threads = 0

    def select(self, timeout: float | None = None) -> Any:
        """Return what is ready, after a wait in virtual time."""
        ready = super().select(0)
        if ready or (timeout is not None and timeout <= 0):
            return ready
        if self.threads:
            return super().select(None)
        now, event = self._clock.now(), self._clock.next_event
        moments = [] if timeout is None else [now + timeout]
        moments += [] if event is None else [event]
        if not moments:
            raise RuntimeError("every task waits, and for nothing that will ever happen")
        # However short the wait, time goes on: or else an event that is due now would hold it up.
        self._clock.move_to(max(min(moments), now + _SHORTEST))
        return super().select(0)


async def _cancel_others() -> None:
    others = asyncio.all_tasks() - {asyncio.current_task()}
    for task in others:
        task.cancel()
    await asyncio.gather(*others, return_exceptions=True)
