"""A virtual bus servo controller: a board that behaves, for programs that have none at hand."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framewire.simulator.clock import RealClock, VirtualClock
    from framewire.simulator.virtual_loop import run_virtual

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
    "run_virtual",
]

# Where they are; each is imported when it is first needed, so that --help is quick.
_HOMES = {
    "busservo_simulator.action_group": ("ActionGroup", "Step"),
    "busservo_simulator.board": ("Board",),
    "busservo_simulator.faults": ("Faults",),
    "busservo_simulator.servo": ("Servo",),
    "busservo_simulator.virtual_controller": ("VirtualController",),
    "framewire.simulator.clock": ("RealClock", "VirtualClock"),
    "framewire.simulator.virtual_loop": ("run_virtual",),
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        for home, names in _HOMES.items():
            if name in names:
                globals()[name] = found = getattr(import_module(home), name)
                return found
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
