"""Progress shown by a thread of its own, for waits that read no clock of ours."""

from __future__ import annotations

import sys
import threading
import time
from contextlib import contextmanager

from .progress import PROGRESS_INTERVAL, Progress

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


# How long one sleep may take, so that Ctrl-C is noticed on every system.
_POLL_INTERVAL = 0.1


@contextmanager
def shown_progress(tell: Callable[[float], str]) -> Iterator[None]:
    """Show each second what `tell` returns for the seconds so far, while the body waits.

    A thread of its own does so: the body reads no clock of ours.
    """
    progress = Progress(sys.stderr)
    if not progress.seen:
        yield
        return
    ended = threading.Event()
    began = time.monotonic()

    def run() -> None:
        while not ended.wait(PROGRESS_INTERVAL):
            progress.show(tell(time.monotonic() - began))

    thread = threading.Thread(target=run, daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
        progress.clear()


def slept(until: float, what: str) -> None:
    """Wait until a time; show what is waited for if it is long."""
    with shown_progress(lambda _: f"{what} in {until - time.monotonic():.0f} s"):
        while (left := until - time.monotonic()) > 0:
            time.sleep(min(left, _POLL_INTERVAL))
