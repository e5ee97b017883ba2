"""The options of the command `busservo-simulator`, their help, and what they refuse."""

from __future__ import annotations

from typing import TYPE_CHECKING

from busservo import __version__
from busservo._library import LINK
from framewire.simulator.line_options import (
    add_fault_arguments,
    add_line_arguments,
    add_output_arguments,
    listed_faults,
    millivolts,
    parser_named,
    servos,
)
from framewire.simulator.tcp_end import LOOPBACK

from busservo_simulator.faults import Faults

if TYPE_CHECKING:
    import argparse

PROGRAM = "busservo-simulator"

_DESCRIPTION = "A virtual bus servo controller: talk to it as to a real one."
_EXAMPLES = f"""\
examples:
  {PROGRAM}                            a board behind a pty, whose name is printed first
  {PROGRAM} --link COM7                the same, by a name that you choose
  {PROGRAM} --tcp 4000                 a board at socket://{LOOPBACK}:4000, on any system
  {PROGRAM} --baud inf                 quicker than the real line: bytes take no time
  {PROGRAM} --servos 1-6,9 --off 9     seven servos, the last of them off
  {PROGRAM} --fault noise=0.2 --fault dropped=0.1 --seed 7
  {PROGRAM} --fault late=0.05 --late-by 3 --fault duplicated=0.05

faults, each by its chance from 0 to 1:
{listed_faults(Faults)}

Bytes take as long as on the real line, at {LINK.baud} baud, unless --baud says otherwise.
A host that sets another rate on the pty than the board's reads garbage, and is read as garbage.
TCP has no rate that could be wrong. Mono's SerialPort opens no pty: have it talk to --tcp.

What happens is printed line by line: the seconds since the start, who, and what. Ctrl-C ends it.
"""


def parser_of(program: str) -> argparse.ArgumentParser:
    """Return the parser of the command, under the name that it was called by."""
    return parser_named(program, PROGRAM, _DESCRIPTION, _EXAMPLES, add_arguments)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of the command."""
    add_line_arguments(parser, LINK.baud)
    board = parser.add_argument_group("what it is")
    board.add_argument(
        "--servos",
        type=servos,
        default=list(range(1, 7)),
        metavar="LIST",
        help="the servos that it has, as in 1-6,9 (default: 1-6)",
    )
    board.add_argument(
        "--missing",
        type=servos,
        default=[],
        metavar="LIST",
        help="those of them that are not plugged in: replies leave them out",
    )
    board.add_argument(
        "--off",
        type=servos,
        default=[],
        metavar="LIST",
        help="those of them that are off: replies give 65535 as their position",
    )
    board.add_argument(
        "--battery",
        type=millivolts,
        default=7500,
        metavar="MV",
        help="the voltage of its battery in mV while nothing moves (default: 7500)",
    )
    board.add_argument(
        "--no-start-report", action="store_true", help="does not report that an action group starts"
    )
    add_fault_arguments(parser, Faults)
    add_output_arguments(parser, f"{PROGRAM} {__version__}")
