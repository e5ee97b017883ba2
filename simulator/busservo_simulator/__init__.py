"""A virtual bus servo controller: a board that behaves, for programs that have none at hand."""

from __future__ import annotations

from framewire.simulator.clock import RealClock, VirtualClock

from busservo_simulator.action_group import ActionGroup, Step
from busservo_simulator.board import Board
from busservo_simulator.faults import Faults
from busservo_simulator.servo import Servo
from busservo_simulator.virtual_controller import VirtualController

__all__ = [
    "ActionGroup",
    "Board",
    "Faults",
    "RealClock",
    "Servo",
    "Step",
    "VirtualClock",
    "VirtualController",
]
