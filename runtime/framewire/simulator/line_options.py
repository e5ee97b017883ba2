"""The options that the commands of all simulators have: where the port is, and what goes wrong."""

from __future__ import annotations

import argparse
import math
import re
from typing import TYPE_CHECKING, TypeVar

from ..command import console, shell_completion
from .line_faults import LineFaults, described
from .servo_list import parse_servos
from .tcp_end import LOOPBACK

if TYPE_CHECKING:
    from collections.abc import Callable

# The highest TCP port, and the most millivolts that a frame carries.
_MOST = 65535
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
        type=_tcp_port,
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
            type=_seconds,
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


def parser_named(
    program: str,
    own: str,
    description: str,
    examples: str,
    declare: Callable[[argparse.ArgumentParser], None],
) -> argparse.ArgumentParser:
    """Return the parser of a command, under the name that it was called by instead of its own."""
    parser = console.Parser(
        prog=program, description=description, epilog=examples.replace(own, program)
    )
    declare(parser)
    if program == own:
        shell_completion.add_option(parser)
    return parser


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


def servos(text: str) -> list[int]:
    """Read a list of servos, as `1-6,9`. Raises ArgumentTypeError."""
    try:
        return parse_servos(text)
    except ValueError:
        known = "servos are numbered 0 to 253, as in 1-6,9"
        raise argparse.ArgumentTypeError(f"{text[:40]!r} names no servos: {known}") from None


def millivolts(text: str) -> int:
    """Read a voltage in mV. Raises ArgumentTypeError."""
    return _number(text, "voltage of a battery in mV")


def _tcp_port(text: str) -> int:
    return _number(text, "TCP port")


def _number(text: str, what: str) -> int:
    if re.fullmatch("[0-9]{1,5}", text) is None or int(text) > _MOST:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no {what}: write one from 0 to {_MOST}")
    return int(text)


def pace(arguments: argparse.Namespace) -> float | None:
    """Return the baud at which bytes take their time; None where they take none."""
    return None if math.isinf(arguments.baud) else arguments.baud


def _baud(text: str) -> float:
    baud = math.inf if text == "inf" else _decimal(text)
    if baud is None or not baud:
        raise argparse.ArgumentTypeError(
            f"{text[:40]!r} is no rate: write one above 0, as 9600, or inf"
        )
    return baud


def _seconds(text: str) -> float:
    seconds = _decimal(text)
    if seconds is None:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no time: write seconds, as 0.5")
    return seconds


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
