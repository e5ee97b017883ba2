"""Devices that a command line lists by their numbers: `1-6,9`."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ..command.numerals import ranges

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping


class Numbered:
    """What a simulator has several of, each with a number: `noun`, from 0 to `highest`."""

    def __init__(self, noun: str, highest: int) -> None:
        self.noun = noun
        self.highest = highest

    def read(self, text: str) -> list[int]:
        """Return the numbers of a list, in order. Raises ArgumentTypeError."""
        try:
            return [
                each for part in text.split(",") for each in ranges(part.strip(), 0, self.highest)
            ]
        except argparse.ArgumentTypeError:
            raise argparse.ArgumentTypeError(
                f"{text[:40]!r} names no {self.noun}s: "
                f"{self.noun}s are numbered 0 to {self.highest}, as in 1-6,9"
            ) from None

    def add(self, group: Any, option: str, *, text: str, default: Collection[int] = ()) -> None:
        """Declare an option that lists some of them, and say what of them by `text`."""
        group.add_argument(
            f"--{option}", type=self.read, default=[*default], metavar="LIST", help=text
        )

    def mark(
        self, option: str, arguments: argparse.Namespace, devices: Mapping[int, object]
    ) -> None:
        """Set the attribute of that name of those that the option lists. Raises ValueError."""
        for number in getattr(arguments, option):
            if number not in devices:
                problem = f"--{option} {number}: there is no such {self.noun}"
                raise ValueError(f"{problem}; see --{self.noun}s")
            setattr(devices[number], option, True)
