"""The option that limits which positions are sent."""

from __future__ import annotations

import argparse

from .._client.exchanges import LIMITS
from .numerals import whole
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .._client.limits import Bounds
    from .._frame.errors import LimitError

_ANY = "none"


def add_limits(parser: argparse.ArgumentParser) -> None:
    """Declare the option, if the protocol has limits."""
    if LIMITS.usual is None:
        return
    others = "".join(f"; {_written(each)} for {name}" for name, each in LIMITS.others.items())
    parser.add_argument(
        "--limits",
        type=_limits,
        default=LIMITS.usual,
        metavar="LOW..HIGH",
        help=f"what may be sent; {_ANY} for anything{others} "
        f"(default: {_written(LIMITS.usual)})".replace("%", "%%"),
    )


def limits_of(arguments: argparse.Namespace) -> Bounds | None:
    """Return the limits that were chosen."""
    chosen: Bounds | None = getattr(arguments, "limits", None)
    return chosen


def refused(error: LimitError) -> UsageError:
    """Return the error for a refused value, in the words of the command line."""
    return outside(error.path, error.value, error.limits)


def outside(place: str, value: object, limits: Bounds) -> UsageError:
    """Return the error for a value outside the limits, with the other limits there are."""
    known = {"what is usual": LIMITS.usual, **LIMITS.others}
    others = [
        f"--limits {_written(each)} is for {name}"
        for name, each in known.items()
        if each is not None and isinstance(value, int) and each[0] <= value <= each[1]
    ]
    ways = ", ".join([*others, f"--limits {_ANY} sends anything"])
    return UsageError(f"{place}: {value} is outside the limits {_written(limits)}; {ways}")


def _written(bounds: Bounds) -> str:
    return f"{bounds[0]}..{bounds[1]}"


def _limits(text: str) -> Bounds | None:
    if text == _ANY:
        return None
    low, dots, high = text.partition("..")
    try:
        bounds = whole(low), whole(high)
    except ValueError:
        bounds = 1, 0
    if not dots or bounds[0] > bounds[1]:
        usual = "" if LIMITS.usual is None else f"like {_written(LIMITS.usual)}"
        raise argparse.ArgumentTypeError(
            f"{text[:40]!r} is no LOW..HIGH: write it {usual}, or {_ANY}"
        )
    return bounds
