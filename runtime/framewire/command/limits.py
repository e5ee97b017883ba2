"""The option that limits which positions are sent."""

from __future__ import annotations

import argparse
from typing import NamedTuple

from .numerals import whole
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..client.limits import Allowed, Bounds, Limits
    from ..frame.errors import LimitError
    from .program import Program

ANY = "none"
"""What stands in the place of limits where anything may be sent."""


class Chosen(NamedTuple):
    """The limits that were chosen, those there are to choose from, and the file that says so.

    The file is empty if an option does.
    """

    allowed: Allowed
    known: Limits
    source: str = ""

    def refused(self, error: LimitError) -> UsageError:
        """Return the error for a refused value, in the words of the command line."""
        return self.outside(error.path, error.value, error.limits, error.owner)

    def outside(self, place: str, value: object, bounds: Bounds, owner: str = "") -> UsageError:
        """Return the error for a value outside its limits, with the other limits there are.

        `owner` says whose limits these are, if each has its own.
        """
        known = {"what is usual": self.known.usual, **self.known.others}
        others = [
            f"--limits {_written(each)} is for {name}"
            for name, each in known.items()
            if each is not None and isinstance(value, int) and each[0] <= value <= each[1]
        ]
        whose = f" of {owner}" if owner else ""
        # The file need not name each of them: others have the usual limits.
        whose += f" in {self.source}" if self.source and bounds != self.known.usual else ""
        ways = ", ".join([*others, f"--limits {ANY} sends anything"])
        problem = f"{value} is outside the limits {_written(bounds)}{whose}"
        return UsageError(f"{place}: {problem}; {ways}")


def add_limits(parser: argparse.ArgumentParser, program: Program) -> None:
    """Declare the option, if the protocol has limits; without it, anything may be sent."""
    limits = program.library.limits
    if limits.usual is None:
        parser.set_defaults(limits=Chosen(None, limits))
        return
    others = "".join(f"; {_written(each)} for {name}" for name, each in limits.others.items())
    parser.add_argument(
        "--limits",
        type=_one_of(limits),
        metavar="LOW..HIGH",
        help=f"what may be sent; {ANY} for anything{others} "
        f"(default: those of {program.settings_file}, else {_written(limits.usual)})".replace(
            "%", "%%"
        ),
    )


def limits_of(arguments: argparse.Namespace) -> Chosen:
    """Return the limits that were chosen."""
    chosen: Chosen = arguments.limits
    return chosen


def _written(bounds: Bounds) -> str:
    return f"{bounds[0]}..{bounds[1]}"


def _one_of(limits: Limits) -> Callable[[str], Chosen]:
    """Return what reads the argument, in a protocol with these limits."""

    def chosen(text: str) -> Chosen:
        if text == ANY:
            return Chosen(None, limits)
        low, dots, high = text.partition("..")
        try:
            bounds = whole(low), whole(high)
        except ValueError:
            bounds = 1, 0
        if not dots or bounds[0] > bounds[1]:
            usual = "" if limits.usual is None else f"like {_written(limits.usual)}"
            raise argparse.ArgumentTypeError(
                f"{text[:40]!r} is no LOW..HIGH: write it {usual}, or {ANY}"
            )
        return Chosen(bounds, limits)

    return chosen
