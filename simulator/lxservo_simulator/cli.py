"""The command `lxservo-simulator`: virtual servos behind a port."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.simulator import command
from framewire.simulator.command import Simulator, via
from framewire.simulator.line_faults import LineFaults
from framewire.simulator.line_options import faults_of, pace

from lxservo_simulator.options import PROGRAM, add_arguments, parser_of

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from lxservo_simulator.virtual_bus import VirtualBus

# What `lxservo simulate` asks for.
__all__ = ["add_arguments", "main"]


def main(argv: Sequence[str] | None = None, *, program: str = PROGRAM) -> int:
    """Run the command line. 0: ended by Ctrl-C; 2: usage error; 141: the reader of its output left.

    `program` is how the command was called. With --quiet, nothing follows the name of the port, so
    its reader may leave.
    """
    return command.main(_SIMULATOR, argv, program)


def _bus(arguments: argparse.Namespace) -> VirtualBus:
    from lxservo_simulator.virtual_bus import VirtualBus  # noqa: PLC0415 - --help is to be quick

    bus = VirtualBus(
        via(arguments),
        servos=arguments.servos,
        baud=pace(arguments),
        local_echo=arguments.local_echo,
        faults=faults_of(arguments, LineFaults),
        link=arguments.link,
        host=arguments.host,
        tcp_port=arguments.tcp or 0,
    )
    for servo_id in arguments.dead:
        if servo_id not in bus.servos:
            raise ValueError(f"--dead {servo_id}: there is no such servo; see --servos")
        bus.servos[servo_id].dead = True
    return bus


_SIMULATOR = Simulator(PROGRAM, parser_of, LineFaults, _bus)
