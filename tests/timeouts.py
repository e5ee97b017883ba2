"""Timeouts of tests, long enough that no slow or pausing machine fails them."""

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TypedDict
from unittest import mock

from framegen.conformance.device import session as firmware_session
from framewire.client import session
from framewire.command.checks import probe

# Far more than anything takes. What comes ends the wait, so that only a failure costs as much.
GENEROUS = 60.0


class Line(TypedDict):
    """Arguments of a client about its line."""

    reply_timeout: float
    baud: float
    settle: float


# A board in this process or on this machine, behind no wire: it may be slow, and never too fast.
LIVE: Line = {"reply_timeout": GENEROUS, "baud": math.inf, "settle": 0}


def await_that(true: Callable[[], object]) -> None:
    """Wait until a condition holds; fail if it takes too long."""
    end = time.monotonic() + GENEROUS
    while not true():
        assert time.monotonic() < end, "it has not come true"
        time.sleep(0.001)


@contextmanager
def undoubted() -> Iterator[None]:
    """Shorten the waits for more bytes: nobody else sends requests, and each reply comes once.

    A client otherwise waits before it sends on a line that was opened just now, and before it
    believes a reply that came sooner than a wire could have carried it; and the doctor and a test
    of firmware wait behind each reply for another.
    """
    with (
        mock.patch.object(session, "_LATENCY", 0.001),
        mock.patch.object(probe, "PAUSE", 0.001),
        mock.patch.object(firmware_session, "_QUIET", 0.001),
    ):
        yield
