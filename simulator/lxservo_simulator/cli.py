"""The command `lxservo simulate`: virtual servos behind a port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from lxservo._library import LIBRARY
from lxservo.runtime import simulator

if TYPE_CHECKING:
    import argparse

    from lxservo_simulator.virtual_bus import VirtualBus

_SERVOS = simulator.Numbered("servo", highest=253)


def _declare(bus: Any) -> None:
    _SERVOS.add(
        bus,
        "servos",
        default=range(1, 7),
        text="the numbers of the servos, as in 1-3,7 (default: 1-6)",
    )
    _SERVOS.add(bus, "dead", text="those of them that neither answer nor move")


def _bus(
    via: Literal["pty", "tcp"], line: simulator.LineSettings, arguments: argparse.Namespace
) -> VirtualBus:
    from lxservo_simulator.virtual_bus import VirtualBus  # noqa: PLC0415 - --help is to be quick

    bus = VirtualBus(via, servos=arguments.servos, **line)
    _SERVOS.mark("dead", arguments, bus.servos)
    return bus


SIMULATOR = simulator.Simulator(
    "lxservo_simulator",
    LIBRARY,
    simulator.LineFaults,
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
