"""The command `busservo-simulator`: a virtual board behind a port."""

from __future__ import annotations

from typing import TYPE_CHECKING

from busservo._cli import console

from busservo_simulator.command import run, via
from busservo_simulator.faults import Faults
from busservo_simulator.line_options import completion, faults_of
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
    return console.run(program, lambda: _run_or_tell(argv, program))


def _run_or_tell(argv: Sequence[str] | None, program: str) -> int:
    arguments = parser_of(program).parse_args(argv)
    try:
        if getattr(arguments, "print_completion", None) is not None:
            print(completion(parser_of(PROGRAM), arguments.print_completion, Faults))
            return console.DONE
        return run(_board, arguments, program)
    except ValueError as error:
        console.complain(program, str(error))
        return console.UNUSABLE


def _board(arguments: argparse.Namespace) -> VirtualController:
    from busservo_simulator.virtual_controller import VirtualController  # noqa: PLC0415 - --help is to be quick

    board = VirtualController(
        via(arguments),
        servos=arguments.servos,
        battery_mv=arguments.battery,
        start_report=not arguments.no_start_report,
        baud=arguments.baud,
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
