"""A virtual bus of LX-16A servos, for programs that have none at hand."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from lxservo_simulator.bus import ServoBus
    from lxservo_simulator.servo import BusServo
    from lxservo_simulator.virtual_bus import VirtualBus

__all__ = ["BusServo", "ServoBus", "VirtualBus"]

# Where they are; each is imported when it is first needed, so that --help is quick.
_HOMES = {"BusServo": "servo", "ServoBus": "bus", "VirtualBus": "virtual_bus"}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        if name not in _HOMES:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = found = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
        return found
