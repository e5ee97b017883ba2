"""A virtual bus of LX-16A servos, for programs that have none at hand."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from lxservo.runtime import simulator

if TYPE_CHECKING:
    from lxservo_simulator.bus import ServoBus
    from lxservo_simulator.servo import BusServo
    from lxservo_simulator.virtual_bus import VirtualBus

    LineFaults = simulator.LineFaults
    RealClock = simulator.RealClock
    VirtualClock = simulator.VirtualClock
    run_virtual = simulator.run_virtual

__all__ = [
    "BusServo",
    "LineFaults",
    "RealClock",
    "ServoBus",
    "VirtualBus",
    "VirtualClock",
    "run_virtual",
]

# Where they are; each is imported when it is first needed, so that --help is quick.
_HOMES = {
    "BusServo": "servo",
    "ServoBus": "bus",
    "VirtualBus": "virtual_bus",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        if name not in __all__:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        home = _HOMES.get(name)
        owner = import_module(f"{__name__}.{home}") if home else simulator
        globals()[name] = found = getattr(owner, name)
        return found
