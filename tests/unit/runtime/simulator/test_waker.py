"""What ends the wait of another thread."""

from __future__ import annotations

import select

from framewire.simulator.waker import Waker

from tests.timeouts import GENEROUS


def test_a_closed_waker_wakes_nobody() -> None:
    waker = Waker()
    waker.wake()
    waker.clear()
    assert waker.fileno() == -1
    waker.open()
    waker.wake()
    assert select.select([waker], [], [], GENEROUS)[0] == [waker]
    waker.clear()
    assert select.select([waker], [], [], 0)[0] == []
    waker.close()
    assert waker.fileno() == -1
