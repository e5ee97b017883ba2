"""The verb `stop`: ends what the device does by itself, then holds everything where it is."""

from __future__ import annotations

from . import hold
from .limits import limits_of
from .link import failures_reported, open_client
from .questions import in_parts
from .send import commanded

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from .program import Program

ENDS = hold.ENDS
ABOUT = hold.ABOUT
add_arguments = hold.add_arguments


def run(arguments: argparse.Namespace, program: Program) -> int:
    """Stop, hold what answers, and say what was held."""
    library, stop = program.library, program.stop_message
    messages = in_parts(stop, [], library) if stop else []
    limits = limits_of(arguments)
    with (
        failures_reported(arguments),
        open_client(arguments, program, limits=limits.allowed) as controller,
    ):
        for message in messages:
            commanded(controller, message, limits)
        return hold.held(controller, library, arguments)
