"""The verb `hold`: commands the positions of the moment."""

from __future__ import annotations

import sys

from ..line.link_errors import NoReplyError
from . import link
from .exit_codes import DONE, NOT_ALL
from .limits import add_limits, limits_of
from .link import add_port, add_timeout, failures_reported, open_client
from .positions import find_present, hold_those_there, nobody, numbers_of, several, the_pose

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from ..client.client import Client
    from ..client.library import Library
    from .program import Program

ENDS = link.ENDS | {NOT_ALL: "not everything was held: something did not answer"}
ABOUT = """\
Reads where everything is, and commands just that: what moves stops, and what is limp gets its force
back. What does not answer is named; the rest is held all the same."""


def add_arguments(parser: argparse.ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "ids",
        nargs="*",
        type=numbers_of(the_pose(program.library)),
        metavar="ID",
        help=f"1, 2 or 1-6 (default: {several(program)})",
    )
    add_port(parser, program)
    add_limits(parser, program)
    add_timeout(parser)


def run(arguments: argparse.Namespace, program: Program) -> int:
    """Hold what answers, and say what was held."""
    limits = limits_of(arguments).allowed
    with (
        failures_reported(arguments),
        open_client(arguments, program, limits=limits) as controller,
    ):
        return held(controller, program.library, arguments)


def held(controller: Client, library: Library, arguments: argparse.Namespace) -> int:
    """Hold what answers, and say what was held; return the exit status."""
    asked = tuple(dict.fromkeys(number for each in arguments.ids for number in each))
    try:
        ids = asked or arguments.settings.ids or find_present(controller, library)
        if not ids:
            print(nobody(the_pose(library)), file=sys.stderr)
            return NOT_ALL
        done = hold_those_there(controller, library, ids, limits_of(arguments).allowed)
    except NoReplyError as error:
        print(error, file=sys.stderr)
        return NOT_ALL
    return DONE if done else NOT_ALL
