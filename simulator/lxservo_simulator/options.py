"""The options of the command `lxservo-simulator`, their help, and what they refuse."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.simulator.line_faults import LineFaults
from framewire.simulator.line_options import (
    add_fault_arguments,
    add_line_arguments,
    add_output_arguments,
    listed_faults,
    parser_named,
    servos,
)
from framewire.simulator.tcp_end import LOOPBACK
from lxservo import __version__
from lxservo._library import LINK

if TYPE_CHECKING:
    import argparse

PROGRAM = "lxservo-simulator"

_DESCRIPTION = "A virtual bus of LX-16A servos: talk to it as to real ones."
_EXAMPLES = f"""\
examples:
  {PROGRAM}                            servos behind a pty, whose name is printed first
  {PROGRAM} --link COM7                the same, by a name that you choose
  {PROGRAM} --tcp 4000                 servos at socket://{LOOPBACK}:4000, on any system
  {PROGRAM} --baud inf                 quicker than the real line: bytes take no time
  {PROGRAM} --servos 1-3,7 --dead 3    four servos, one of which does not answer
  {PROGRAM} --local-echo               a wire that both ends share, without an adapter
  {PROGRAM} --fault noise=0.2 --fault dropped=0.1 --seed 7

faults, each by its chance from 0 to 1:
{listed_faults(LineFaults)}

Bytes take as long as on the real line, at {LINK.baud} baud, unless --baud says otherwise.

What happens is printed line by line: the seconds since the start, who, and what. Ctrl-C ends it.
"""


def parser_of(program: str) -> argparse.ArgumentParser:
    """Return the parser of the command, under the name that it was called by."""
    return parser_named(program, PROGRAM, _DESCRIPTION, _EXAMPLES, add_arguments)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of the command."""
    add_line_arguments(parser, LINK.baud)
    bus = parser.add_argument_group("what it is")
    bus.add_argument(
        "--servos",
        type=servos,
        default=list(range(1, 7)),
        metavar="LIST",
        help="the numbers of the servos, as in 1-3,7 (default: 1-6)",
    )
    bus.add_argument(
        "--dead",
        type=servos,
        default=[],
        metavar="LIST",
        help="those of them that neither answer nor move",
    )
    add_fault_arguments(parser, LineFaults)
    add_output_arguments(parser, f"{PROGRAM} {__version__}")
