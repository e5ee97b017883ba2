"""The command `lxservo-simulator`: virtual servos behind a port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from framewire.simulator.command import Simulator
from framewire.simulator.line_faults import LineFaults
from framewire.simulator.numbered import Numbered
from lxservo._library import LIBRARY

if TYPE_CHECKING:
    import argparse

    from framewire.simulator.virtual_line import LineSettings

    from lxservo_simulator.virtual_bus import VirtualBus

_SERVOS = Numbered("servo", highest=253)


def _declare(bus: Any) -> None:
    _SERVOS.add(
        bus,
        "servos",
        default=range(1, 7),
        text="the numbers of the servos, as in 1-3,7 (default: 1-6)",
    )
    _SERVOS.add(bus, "dead", text="those of them that neither answer nor move")


def _bus(
    via: Literal["pty", "tcp"], line: LineSettings, arguments: argparse.Namespace
) -> VirtualBus:
    from lxservo_simulator.virtual_bus import VirtualBus  # noqa: PLC0415 - --help is to be quick

    bus = VirtualBus(via, servos=arguments.servos, **line)
    _SERVOS.mark("dead", arguments, bus.servos)
    return bus


SIMULATOR = Simulator(
    "lxservo-simulator",
    LIBRARY,
    LineFaults,
    description="A virtual bus of LX-16A servos: talk to it as to real ones.",
    noun="servos",
    examples=(
        ("--servos 1-3,7 --dead 3", "four servos, one of which does not answer"),
        ("--local-echo", "a wire that both ends share, without an adapter"),
        ("--fault noise=0.2 --fault dropped=0.1 --seed 7", ""),
    ),
    declare=_declare,
    make=_bus,
)
# What `lxservo simulate` asks for.
add_arguments, main = SIMULATOR.add_arguments, SIMULATOR.main
