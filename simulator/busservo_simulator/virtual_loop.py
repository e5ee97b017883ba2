"""Where `run_virtual` has its name for programs that test a robot."""

from __future__ import annotations

from framewire.simulator.virtual_loop import VirtualLoop, run_virtual

__all__ = ["VirtualLoop", "run_virtual"]
