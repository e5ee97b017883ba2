"""The command `busservo-simulator`: a virtual board that waits behind a port."""

from __future__ import annotations

import argparse
import re
import signal
import sys
import threading
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

from busservo import __version__
from busservo.cli import console
from busservo.protocol import BAUD

from busservo_simulator.faults import CHANCES, TO_BOARD, Faults
from busservo_simulator.servo_list import parse_servos
from busservo_simulator.tcp_end import LOOPBACK

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from busservo_simulator.virtual_controller import VirtualController

PROGRAM = "busservo-simulator"
# What a TCP port and a battery's millivolts are sent as.
_MOST = 65535
FROM_BOARD = [name for name in CHANCES if name not in TO_BOARD]
EXAMPLES = f"""\
examples:
  {PROGRAM}                            a board behind a pty, whose name is printed first
  {PROGRAM} --link COM7                the same, by a name that you choose
  {PROGRAM} --tcp 4000                 a board at socket://{LOOPBACK}:4000, on any system
  {PROGRAM} --baud                     as slow as the real line, {BAUD} baud
  {PROGRAM} --servos 1-6,9 --off 9     seven servos, the last of them off
  {PROGRAM} --fault noise=0.2 --fault dropped=0.1 --seed 7

faults, each a chance from 0 to 1, of what the board sends:
  {", ".join(FROM_BOARD[:6])},
  {", ".join(FROM_BOARD[6:])}
and of what it is sent:
  {", ".join(TO_BOARD)}

What happens is printed line by line: the seconds since the start, who, and what. Ctrl-C ends it.
"""


def main(argv: Sequence[str] | None = None, *, program: str = PROGRAM) -> int:
    """Runs the command line. 0: ended by Ctrl-C; 2: unusable; 141: whoever read along has gone.

    `program` is how the command was called: it is a verb of another one, too.
    """
    return console.run(program, lambda: _run_or_tell(argv, program))


def _run_or_tell(argv: Sequence[str] | None, program: str) -> int:
    arguments = _parser(program).parse_args(argv)
    try:
        return _run(arguments)
    except ValueError as error:
        console.complain(program, str(error))
        return console.UNUSABLE


def _parser(program: str) -> argparse.ArgumentParser:
    parser = console.Parser(
        prog=program,
        description="A virtual bus servo controller: talk to it as to a real one.",
        epilog=EXAMPLES.replace(PROGRAM, program),
    )
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
        type=float,
        metavar="BAUD",
        help=f"bytes take their time, as at so many baud (without a number: {BAUD})",
    )
    board = parser.add_argument_group("what it is")
    board.add_argument("--servos", type=_servos, default=list(range(1, 7)), metavar="LIST")
    board.add_argument("--missing", type=_servos, default=[], metavar="LIST")
    board.add_argument("--off", type=_servos, default=[], metavar="LIST")
    board.add_argument(
        "--battery", type=_millivolts, default=7500, metavar="MV", help="default: 7500"
    )
    board.add_argument(
        "--no-start-report", action="store_true", help="does not report that an action group starts"
    )
    faults = parser.add_argument_group("what goes wrong")
    faults.add_argument(
        "--fault", type=_fault, action="append", default=[], metavar="NAME=CHANCE", dest="faults"
    )
    faults.add_argument("--seed", type=int, default=0, help="which run of faults (default: 0)")
    parser.add_argument("--quiet", action="store_true", help="print the port and nothing else")
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {__version__}")
    return parser


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


def _fault(text: str) -> tuple[str, float]:
    name, _, chance = text.partition("=")
    if name not in CHANCES:
        raise argparse.ArgumentTypeError(f"no fault is called {name!r}; {', '.join(CHANCES)} are")
    try:
        return name, float(chance)
    except ValueError:
        raise argparse.ArgumentTypeError(f"write a chance, such as {name}=0.1") from None


def _run(arguments: argparse.Namespace) -> int:
    if arguments.host not in {LOOPBACK, "::1", "localhost"}:
        host = console.visible(arguments.host)
        print(f"{PROGRAM}: the network reaches it at {host}", file=sys.stderr)
    with _ended_by_signals() as ended, _opened(arguments) as board:
        journal = board.board.journal
        named = threading.Event()
        if not arguments.quiet:
            journal.listener = _printer(named, ended)
        print(console.visible(board.port), flush=True)
        named.set()
        # In slices: on Windows a wait without end cannot be interrupted.
        while not ended.is_set():
            ended.wait(0.5)
        journal.listener = None
        print(f"{board.accepted} messages, {board.rejects.total} rejected", file=sys.stderr)
    return 0


def _printer(named: threading.Event, ended: threading.Event) -> Callable[[str], None]:
    """Prints lines as they come, but none in front of the name of the port, and loses none."""

    def show(line: str) -> None:
        named.wait()
        try:
            print(line, flush=True)
        except OSError:  # whoever read along has gone, and console.run tells the shell
            ended.set()

    return show


@contextmanager
def _opened(arguments: argparse.Namespace) -> Iterator[VirtualController]:
    """The board behind its port. Raises ValueError where there cannot be such a port."""
    board = _board(arguments)
    with ExitStack() as port:
        try:
            port.enter_context(board)
        except OSError as error:
            where = "a pty" if arguments.link is None else f"the link {arguments.link!r}"
            if _is_tcp(arguments):
                where = f"{arguments.host}, port {arguments.tcp or 0}"
            raise ValueError(f"{where} cannot be opened: {error.strerror or error}") from None
        yield board


def _is_tcp(arguments: argparse.Namespace) -> bool:
    return arguments.tcp is not None or sys.platform == "win32"


def _board(arguments: argparse.Namespace) -> VirtualController:
    from busservo_simulator.virtual_controller import VirtualController  # noqa: PLC0415 - --help is to be quick

    tcp = _is_tcp(arguments)
    if tcp and arguments.link is not None:
        raise ValueError("--link names a pty, and there is none with --tcp")
    board = VirtualController(
        "tcp" if tcp else "pty",
        servos=arguments.servos,
        battery_mv=arguments.battery,
        start_report=not arguments.no_start_report,
        baud=arguments.baud,
        faults=Faults(seed=arguments.seed, **dict(arguments.faults)),
        link=arguments.link,
        host=arguments.host,
        tcp_port=arguments.tcp or 0,
    )
    for attribute in ("missing", "off"):
        for servo_id in getattr(arguments, attribute):
            if servo_id not in board.servos:
                raise ValueError(f"--{attribute} {servo_id}: there is no such servo; see --servos")
            setattr(board.servos[servo_id], attribute, True)
    return board


@contextmanager
def _ended_by_signals() -> Iterator[threading.Event]:
    """An event that SIGINT and SIGTERM set, so that links and ports are always given back."""
    ended = threading.Event()
    kinds = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(kind, lambda *_: ended.set()) for kind in kinds]
    try:
        yield ended
    finally:
        for kind, handler in zip(kinds, before, strict=True):
            signal.signal(kind, handler)
