"""Virtual devices: a line on which bytes take their time and faults happen, its ports, its time."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .clock import RealClock, VirtualClock
    from .command import Simulator
    from .line_faults import LineFaults
    from .numbered import Numbered
    from .travel import Travel
    from .virtual_device import VirtualDevice
    from .virtual_line import LineSettings, VirtualLine
    from .virtual_loop import run_virtual

__all__ = [
    "LineFaults",
    "LineSettings",
    "Numbered",
    "RealClock",
    "Simulator",
    "Travel",
    "VirtualClock",
    "VirtualDevice",
    "VirtualLine",
    "run_virtual",
]

# Where they are; each is imported when it is first needed, so that --help is quick.
_HOMES = {
    "clock": ("RealClock", "VirtualClock"),
    "command": ("Simulator",),
    "line_faults": ("LineFaults",),
    "numbered": ("Numbered",),
    "travel": ("Travel",),
    "virtual_device": ("VirtualDevice",),
    "virtual_line": ("LineSettings", "VirtualLine"),
    "virtual_loop": ("run_virtual",),
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> object:
        for home, names in _HOMES.items():
            if name in names:
                module = import_module(f"{__name__}.{home}")
                globals()[name] = found = getattr(module, name)
                return found
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
