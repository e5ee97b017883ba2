"""A clock that is moved by hand."""

from __future__ import annotations

import pytest
from busservo import ServoMove
from busservo_simulator import VirtualClock, VirtualController

from tests.lines.hosts import Host


def test_time_stands_still_until_it_is_moved_on() -> None:
    with VirtualController(clock=VirtualClock()) as board:
        host = Host(board.transport)
        host.say(ServoMove(1000, [(1, 900)]))
        assert host.receive(0.01) is None
        assert board.servos[1].position == 500
        board.advance(0.25)
        assert board.servos[1].position == 600


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
