"""A virtual bus of LX-16A servos, for programs that have none at hand."""

from __future__ import annotations

from lxservo_simulator.bus import ServoBus
from lxservo_simulator.servo import BusServo
from lxservo_simulator.virtual_bus import VirtualBus

__all__ = ["BusServo", "ServoBus", "VirtualBus"]
