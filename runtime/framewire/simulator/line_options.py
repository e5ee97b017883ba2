"""The options that the commands of all simulators have: where the port is, and what goes wrong."""

from __future__ import annotations

import argparse
import math
import re
import sys
from typing import TYPE_CHECKING, Literal, TypeVar

from ..command import shell_completion
from .line_faults import LineFaults, described
from .tcp_end import LOOPBACK

if TYPE_CHECKING:
    from collections.abc import Callable

    from .virtual_line import LineSettings

_HIGHEST_PORT = 65535
_Faults = TypeVar("_Faults", bound=LineFaults)


def listed_faults(kind: type[LineFaults]) -> str:
    """Return the chances of faults for a help text, a line each."""
    return "\n".join(f"  {name:20}{what}" for name, what in described(kind, "chance").items())


def add_line_arguments(parser: argparse.ArgumentParser, baud: int) -> None:
    """Declare where the port is, and how slow the line."""
    where = parser.add_argument_group("where it is")
    where.add_argument("--link", metavar="PATH", help="a name for the pty, a symlink")
    where.add_argument(
        "--tcp",
        nargs="?",
        const=0,
        type=up_to(_HIGHEST_PORT, "TCP port"),
        metavar="PORT",
        help="a TCP port instead of a pty (default: any free one); always so on Windows",
    )
    where.add_argument(
        "--host",
        default=LOOPBACK,
        help=f"the address to listen at (default: {LOOPBACK}, this machine alone)",
    )
    where.add_argument(
        "--baud",
        type=_baud,
        default=float(baud),
        metavar="BAUD",
        help="the rate of the line, at which bytes take their time; inf: they arrive at once, "
        f"and a pty keeps the rate {baud} (default: {baud})",
    )
    where.add_argument(
        "--local-echo",
        action="store_true",
        default=None,
        help="what a host sends comes back to it, as from many half-duplex adapters",
    )


def add_fault_arguments(parser: argparse.ArgumentParser, kind: type[LineFaults]) -> None:
    """Declare what goes wrong."""
    faults = parser.add_argument_group("what goes wrong")
    faults.add_argument(
        "--fault",
        type=_fault_of(kind),
        action="append",
        default=[],
        metavar="NAME=CHANCE",
        dest="faults",
        help="a fault from the list below, and its chance from 0 to 1; any number of times",
    )
    for name, what in described(kind, "seconds").items():
        default = getattr(kind(), name)
        faults.add_argument(
            f"--{name.replace('_', '-')}",
            type=seconds,
            default=default,
            metavar="SECONDS",
            help=f"{what} (default: {default:g})",
        )
    faults.add_argument(
        "--seed",
        type=_seed,
        default=0,
        help="which run of faults: the same seed and the same traffic repeat it (default: 0)",
    )


def add_output_arguments(parser: argparse.ArgumentParser, version: str) -> None:
    """Declare what is printed; `version` is the program's, with its name."""
    parser.add_argument("--quiet", action="store_true", help="print the port and nothing else")
    parser.add_argument("--version", action="version", version=version)


def faults_of(arguments: argparse.Namespace, kind: type[_Faults]) -> _Faults:
    """Return the faults that the arguments choose."""
    durations = {name: getattr(arguments, name) for name in described(kind, "seconds")}
    return kind(seed=arguments.seed, **dict(arguments.faults), **durations)


def completion(parser: argparse.ArgumentParser, shell: str, kind: type[LineFaults]) -> str:
    """Return what a shell needs to complete a command. Raises ValueError where none is made."""
    chances = shell_completion.Words([f"{name}=" for name in described(kind, "chance")])

    def candidates(_command: str, action: argparse.Action) -> shell_completion.Candidates | None:
        if action.metavar == "NAME=CHANCE":
            return chances
        return shell_completion.Files() if action.metavar == "PATH" else None

    try:
        return shell_completion.script(parser, shell, candidates)
    except shell_completion.CompletionError as error:
        raise ValueError(str(error)) from None


def up_to(highest: int, what: str) -> Callable[[str], int]:
    """Return the argument type of a whole number from 0 to `highest`, which is some `what`."""

    def read(text: str) -> int:
        if re.fullmatch("[0-9]{1,9}", text) is None or int(text) > highest:
            raise argparse.ArgumentTypeError(
                f"{text[:40]!r} is no {what}: write one from 0 to {highest}"
            )
        return int(text)

    return read


def via(arguments: argparse.Namespace) -> Literal["pty", "tcp"]:
    """Return what kind of port is asked for. Raises ValueError for a link without a pty."""
    if arguments.tcp is None and sys.platform != "win32":
        return "pty"
    if arguments.link is not None:
        raise ValueError("--link names a pty, and there is none with --tcp")
    return "tcp"


def line_of(arguments: argparse.Namespace, kind: type[LineFaults]) -> LineSettings:
    """Return the line that the arguments choose, with its faults; it is paced, unless at inf."""
    return {
        "baud": None if math.isinf(arguments.baud) else arguments.baud,
        "local_echo": arguments.local_echo,
        "faults": faults_of(arguments, kind),
        "link": arguments.link,
        "host": arguments.host,
        "tcp_port": arguments.tcp or 0,
    }


def _baud(text: str) -> float:
    baud = math.inf if text == "inf" else _decimal(text)
    if baud is None or not baud:
        raise argparse.ArgumentTypeError(
            f"{text[:40]!r} is no rate: write one above 0, as 9600, or inf"
        )
    return baud


def seconds(text: str) -> float:
    """Return a time of 0 seconds or more. Raises ArgumentTypeError."""
    number = _decimal(text)
    if number is None:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no time: write seconds, as 0.5")
    return number


def _seed(text: str) -> int:
    if re.fullmatch("[0-9]{1,18}", text) is None:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no seed: write a whole number, as 7")
    return int(text)


def _fault_of(kind: type[LineFaults]) -> Callable[[str], tuple[str, float]]:
    """Return what reads a fault and its chance."""
    chances = described(kind, "chance")

    def fault(text: str) -> tuple[str, float]:
        name, _, written = text.partition("=")
        if name not in chances:
            raise argparse.ArgumentTypeError(
                f"no fault is called {name[:40]!r}; {', '.join(chances)} are"
            )
        chance = _decimal(written)
        if chance is None or chance > 1:
            raise argparse.ArgumentTypeError(
                f"{written[:40]!r} is no chance: write one from 0 to 1, as {name}=0.1"
            )
        return name, chance

    return fault


def _decimal(text: str) -> float | None:
    """Return a number of 0 or more; None for any other text."""
    written = re.fullmatch(r"[0-9]{1,9}(\.[0-9]{0,9})?|\.[0-9]{1,9}", text)
    return float(text) if written else None
