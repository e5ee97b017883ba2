"""Gates at which a thread waits until the test lets it go on, and what holds of closing."""

import asyncio
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, wait
from typing import Any

import pytest
from busservo import ClosedError

from tests.timeouts import GENEROUS


class Gate:
    """A hook that waits until the test lets it go on, and calls `meanwhile` before it waits."""

    def __init__(self, meanwhile: Callable[[], object] = int) -> None:
        self.meanwhile = meanwhile
        self.begun, self.go_on = threading.Event(), threading.Event()

    def __call__(self) -> None:
        self.meanwhile()
        self.begun.set()
        assert self.go_on.wait(GENEROUS)

    def wait(self) -> None:
        """Wait until somebody is at the gate."""
        assert self.begun.wait(GENEROUS)

    async def reached(self) -> None:
        """Wait likewise, in a task."""
        while not self.begun.is_set():
            await asyncio.sleep(0.001)


def whoever_closes_second_waits(closable: Any, closing: Gate, line: Any) -> None:
    """Check that nobody's close returns before the `line` is closed, which waits at the gate."""

    def close_too() -> bool:
        closable.close()
        return bool(line.closed)

    with ThreadPoolExecutor() as pool:
        first = pool.submit(closable.close)
        closing.wait()
        others = [pool.submit(close_too) for _ in range(3)]
        done, _ = wait(others, timeout=0.05)
        closing.go_on.set()
        assert not done, "it is not closed yet"
        assert [each.result(GENEROUS) for each in others] == [True] * 3
        first.result(GENEROUS)


def closing_ends_a_read(port: Any) -> None:
    """Check that a read in another thread ends as its port is closed."""

    def read() -> None:
        with pytest.raises(ClosedError):
            port.read(2 * GENEROUS)

    with ThreadPoolExecutor() as pool:
        reading = pool.submit(read)
        port.close()
        reading.result(GENEROUS)
