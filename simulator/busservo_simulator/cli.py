"""The command `busservo-simulator`: a virtual board behind a port."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.simulator import command
from framewire.simulator.command import Simulator, via
from framewire.simulator.line_options import faults_of, pace

from busservo_simulator.faults import Faults
from busservo_simulator.options import PROGRAM, add_arguments, parser_of

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from busservo_simulator.virtual_controller import VirtualController

# What `busservo simulate` asks for.
__all__ = ["add_arguments", "main"]


def main(argv: Sequence[str] | None = None, *, program: str = PROGRAM) -> int:
    """Run the command line. 0: ended by Ctrl-C; 2: usage error; 141: the reader of its output left.

    `program` is how the command was called: it is a verb of another one, too. With --quiet, nothing
    follows the name of the port, so its reader may leave.
    """
    return command.main(_SIMULATOR, argv, program)


def _board(arguments: argparse.Namespace) -> VirtualController:
    from busservo_simulator.virtual_controller import VirtualController  # noqa: PLC0415 - --help is to be quick

    board = VirtualController(
        via(arguments),
        servos=arguments.servos,
        battery_mv=arguments.battery,
        start_report=not arguments.no_start_report,
        baud=pace(arguments),
        local_echo=arguments.local_echo,
        faults=faults_of(arguments, Faults),
        link=arguments.link,
        host=arguments.host,
        tcp_port=arguments.tcp or 0,
    )
    for attribute in ("missing", "off"):
        for servo_id in getattr(arguments, attribute):
            if servo_id not in board.servos:
                raise ValueError(f"--{attribute} {servo_id}: there is no such servo; see --servos")
            setattr(board.servos[servo_id], attribute, True)
    return board


_SIMULATOR = Simulator(PROGRAM, parser_of, Faults, _board)
