"""Numbers as arguments: plain digits, and nothing else that Python would take for a number."""

from __future__ import annotations

import argparse
import math
import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

_WHOLE = re.compile(r"-?[0-9]+")
_ANY_BASE = re.compile(r"-?(?:0[xX][0-9A-Fa-f]+|0[oO][0-7]+|0[bB][01]+|0+|[1-9][0-9]*)")
_DECIMAL = re.compile(r"-?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?|inf")
# Far more digits than any number here has; Python refuses to read some thousands.
_MOST_DIGITS = 100
# How far from a whole number of steps a time may be, as floats are.
_NEAR = 1e-6


def whole(text: str) -> int:
    """Return a whole number, in decimal. Raises ValueError."""
    if len(text) > _MOST_DIGITS or _WHOLE.fullmatch(text) is None:
        raise ValueError(f"{text[:40]!r} is no whole number: write it like 12")
    return int(text)


def whole_in_any_base(text: str) -> int:
    """Return a whole number: in decimal, or such as 0x0C, 0o14 or 0b1100. Raises ValueError."""
    if len(text) > _MOST_DIGITS or _ANY_BASE.fullmatch(text) is None:
        raise ValueError(f"{text[:40]!r} is no whole number: write it like 12 or 0x0C")
    return int(text, 0)


def at_least(lowest: int) -> Callable[[str], int]:
    """Return the argument type of a whole number with a lower bound."""

    def read(text: str) -> int:
        try:
            given = whole(text)
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
        if given < lowest:
            raise argparse.ArgumentTypeError(f"{given} is below {lowest}, the least there can be")
        return given

    return read


def above_zero(*, highest: float = math.inf, unit: str = "") -> Callable[[str], float]:
    """Return the argument type of a number above 0 and up to a bound; inf only without a bound."""

    def read(text: str) -> float:
        given = _decimal(text, unit)
        if not 0 < given <= highest:
            bound = "" if math.isinf(highest) else f" and up to {highest:g} {unit}".rstrip()
            raise argparse.ArgumentTypeError(f"{text} is not above 0{bound}")
        return given

    return read


def from_zero(*, highest: float, unit: str) -> Callable[[str], float]:
    """Return the argument type of a number from 0 up to a bound."""

    def read(text: str) -> float:
        given = _decimal(text, unit)
        if not 0 <= given <= highest:
            raise argparse.ArgumentTypeError(f"{text} is not in 0..{highest:g} {unit}")
        return given

    return read


def ranges(text: str, lowest: int, highest: int) -> tuple[int, ...]:
    """Return the numbers of an argument such as `1-6,9`. Raises ArgumentTypeError."""
    found: dict[int, None] = {}
    for part in text.split(","):
        first, dash, last = part.partition("-")
        try:
            low, high = whole(first), whole(last if dash else first)
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"{part[:40]!r} is neither a number nor a range like 1-6"
            ) from None
        if not lowest <= low <= high <= highest:
            bounds = f"{lowest}..{highest}"
            problem = f"is outside {bounds}" if low <= high else "has its higher number first"
            raise argparse.ArgumentTypeError(f"{part[:40]} {problem}")
        found |= dict.fromkeys(range(low, high + 1))
    return tuple(found)


def steps_of_time(*, highest: int, per_second: int) -> Callable[[str], int]:
    """Return the argument type of a time, `1s`, `500ms` or seconds, as a number of steps."""

    def read(text: str) -> int:
        unit = 1000 if text.endswith("ms") else 1
        number = text.removesuffix("ms").removesuffix("s")
        if len(number) > _MOST_DIGITS or _DECIMAL.fullmatch(number) is None or "inf" in number:
            raise argparse.ArgumentTypeError(f"{text[:40]!r} is no time: write it like 1s or 500ms")
        steps = float(number) * per_second / unit
        if not 0 <= steps <= highest:
            bound = f"{highest / per_second:g}s"
            raise argparse.ArgumentTypeError(f"{text} is not in 0s..{bound}")
        # 0.29 s are 290 ms, though the nearest float is a little less.
        if abs(steps - round(steps)) > _NEAR:
            step = {1: "s", 1000: "ms"}[per_second]
            raise argparse.ArgumentTypeError(f"{text} is no whole number of {step}")
        return round(steps)

    return read


def _decimal(text: str, unit: str) -> float:
    if len(text) > _MOST_DIGITS or _DECIMAL.fullmatch(text) is None:
        what = f"number of {unit}" if unit else "number"
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no {what}: write it like 12 or 0.5")
    return float(text)
