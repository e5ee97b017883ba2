"""The options of the command `busservo-simulator`, their help, and what they refuse."""

from __future__ import annotations

import argparse
import re
from typing import TYPE_CHECKING

from busservo import __version__
from busservo._cli import console, shell_completion
from busservo._frame.protocol import BAUD

from busservo_simulator.faults import CHANCES, DURATIONS, Faults
from busservo_simulator.servo_list import parse_servos
from busservo_simulator.tcp_end import LOOPBACK

if TYPE_CHECKING:
    from collections.abc import Mapping

PROGRAM = "busservo-simulator"
# The highest TCP port, and the most millivolts that a frame carries.
_MOST = 65535


def _listed(chances: Mapping[str, str]) -> str:
    return "\n".join(f"  {name:20}{what}" for name, what in chances.items())


_EXAMPLES = f"""\
examples:
  {PROGRAM}                            a board behind a pty, whose name is printed first
  {PROGRAM} --link COM7                the same, by a name that you choose
  {PROGRAM} --tcp 4000                 a board at socket://{LOOPBACK}:4000, on any system
  {PROGRAM} --baud                     as slow as the real line, {BAUD} baud
  {PROGRAM} --servos 1-6,9 --off 9     seven servos, the last of them off
  {PROGRAM} --fault noise=0.2 --fault dropped=0.1 --seed 7
  {PROGRAM} --baud --fault late=0.05 --late-by 3 --fault duplicated=0.05

faults, each by its chance from 0 to 1:
{_listed(CHANCES)}

A host that sets another rate on the pty than the board's reads garbage, and is read as garbage.
TCP has no rate that could be wrong. Mono's SerialPort opens no pty: have it talk to --tcp.

What happens is printed line by line: the seconds since the start, who, and what. Ctrl-C ends it.
"""


def parser_of(program: str) -> argparse.ArgumentParser:
    """Return the parser of the command, under the name that it was called by."""
    parser = console.Parser(
        prog=program,
        description="A virtual bus servo controller: talk to it as to a real one.",
        epilog=_EXAMPLES.replace(PROGRAM, program),
    )
    add_arguments(parser)
    if program == PROGRAM:
        shell_completion.add_option(parser)
    return parser


def completion(shell: str) -> str:
    """Return what a shell needs to complete the command. Raises ValueError where none is made."""
    try:
        return shell_completion.script(parser_of(PROGRAM), shell, _candidates)
    except shell_completion.CompletionError as error:
        raise ValueError(str(error)) from None


def _candidates(_command: str, action: argparse.Action) -> shell_completion.Candidates | None:
    if action.metavar == "NAME=CHANCE":
        return shell_completion.Words([f"{name}=" for name in CHANCES])
    return shell_completion.Files() if action.metavar == "PATH" else None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options of the command."""
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
        nargs="?",
        const=float(BAUD),
        type=_baud,
        metavar="BAUD",
        help=f"bytes take their time, as at so many baud (without a number: {BAUD}); "
        f"without this option they are there at once, and the rate of the board is {BAUD}",
    )
    where.add_argument(
        "--local-echo",
        action="store_true",
        help="what a host sends comes back to it, as from many half-duplex adapters",
    )
    board = parser.add_argument_group("what it is")
    board.add_argument(
        "--servos",
        type=_servos,
        default=list(range(1, 7)),
        metavar="LIST",
        help="the servos that it knows, as in 1-6,9 (default: 1-6)",
    )
    board.add_argument(
        "--missing",
        type=_servos,
        default=[],
        metavar="LIST",
        help="those of them that are not plugged in: replies leave them out",
    )
    board.add_argument(
        "--off",
        type=_servos,
        default=[],
        metavar="LIST",
        help="those of them that are off: replies give 65535 as their position",
    )
    board.add_argument(
        "--battery",
        type=_millivolts,
        default=7500,
        metavar="MV",
        help="the voltage of its battery in mV while nothing moves (default: 7500)",
    )
    board.add_argument(
        "--no-start-report", action="store_true", help="does not report that an action group starts"
    )
    faults = parser.add_argument_group("what goes wrong")
    faults.add_argument(
        "--fault",
        type=_fault,
        action="append",
        default=[],
        metavar="NAME=CHANCE",
        dest="faults",
        help="a fault from the list below, and its chance from 0 to 1; any number of times",
    )
    for name, what in DURATIONS.items():
        default = getattr(Faults(), name)
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
    parser.add_argument("--quiet", action="store_true", help="print the port and nothing else")
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {__version__}")


def _servos(text: str) -> list[int]:
    try:
        return parse_servos(text)
    except ValueError:
        known = "servos are numbered 0 to 253, as in 1-6,9"
        raise argparse.ArgumentTypeError(f"{text[:40]!r} names no servos: {known}") from None


def _tcp_port(text: str) -> int:
    return _number(text, "TCP port")


def _millivolts(text: str) -> int:
    return _number(text, "voltage of a battery in mV")


def _number(text: str, what: str) -> int:
    if re.fullmatch("[0-9]{1,5}", text) is None or int(text) > _MOST:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no {what}: write one from 0 to {_MOST}")
    return int(text)


def _baud(text: str) -> float:
    baud = _decimal(text)
    if baud is None or not baud:
        raise argparse.ArgumentTypeError(f"{text[:40]!r} is no rate: write one above 0, as {BAUD}")
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


def _fault(text: str) -> tuple[str, float]:
    name, _, written = text.partition("=")
    if name not in CHANCES:
        raise argparse.ArgumentTypeError(
            f"no fault is called {name[:40]!r}; {', '.join(CHANCES)} are"
        )
    chance = _decimal(written)
    if chance is None or chance > 1:
        raise argparse.ArgumentTypeError(
            f"{written[:40]!r} is no chance: write one from 0 to 1, as {name}=0.1"
        )
    return name, chance


def _decimal(text: str) -> float | None:
    """Return a number of 0 or more; None for any other text."""
    written = re.fullmatch(r"[0-9]{1,9}(\.[0-9]{0,9})?|\.[0-9]{1,9}", text)
    return float(text) if written else None


def faults_of(arguments: argparse.Namespace) -> Faults:
    """Return the faults that the arguments choose."""
    durations = {name: getattr(arguments, name) for name in DURATIONS}
    return Faults(seed=arguments.seed, **dict(arguments.faults), **durations)
