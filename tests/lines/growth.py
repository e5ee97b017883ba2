"""What a long run leaves behind: caches that grow by a little, and never by a message each."""

import gc
import sys
import threading
import time

SPARE_BLOCKS = 2000
# Fewer requests do not even fill what is kept on purpose: logs, and the latest reports.
ENOUGH = 50_000


class Growth:
    """A check that neither memory nor threads grow from round to round."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._blocks: list[int] = []
        self._threads: list[int] = []
        self._began = time.monotonic()

    def round(self, done: int) -> None:
        """End a round, after so many requests in all."""
        gc.collect()
        self._blocks.append(sys.getallocatedblocks())
        self._threads.append(threading.active_count())
        if sys.stderr.isatty():
            print(f"\r{self._name}: {done} requests", end="", file=sys.stderr, flush=True)

    def end(self, requests: int, result: str) -> None:
        """Print the result. Raises AssertionError if something has grown."""
        fifth = len(self._blocks) // 5
        grown = min(self._blocks[-3:]) - min(self._blocks[fifth : fifth + 3])
        first, last = self._threads[0], self._threads[-1]
        print(
            f"{self._name}: {requests} requests in {time.monotonic() - self._began:.0f} s; "
            f"{result}; memory grew by {grown} blocks, threads from {first} to {last}",
            flush=True,
        )
        assert requests < ENOUGH or grown < SPARE_BLOCKS, f"memory grows: {self._blocks}"
        assert last <= first, f"threads grow: {self._threads}"
