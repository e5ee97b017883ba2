"""The command `busservo-simulator`: a virtual board behind a port."""

from __future__ import annotations

import select
import signal
import sys
import threading
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING

from busservo._cli import console
from busservo._frame.pluralize import pluralize

from busservo_simulator.options import PROGRAM, add_arguments, completion, faults_of, parser_of
from busservo_simulator.tcp_end import LOOPBACK

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterator, Sequence

    from busservo_simulator.virtual_controller import VirtualController

# What `busservo simulate` asks for.
__all__ = ["add_arguments", "main"]


def main(argv: Sequence[str] | None = None, *, program: str = PROGRAM) -> int:
    """Run the command line. 0: ended by Ctrl-C; 2: usage error; 141: the reader of its output left.

    `program` is how the command was called: it is a verb of another one, too. With --quiet, nothing
    follows the name of the port, so its reader may leave.
    """
    return console.run(program, lambda: _run_or_tell(argv, program))


def _run_or_tell(argv: Sequence[str] | None, program: str) -> int:
    arguments = parser_of(program).parse_args(argv)
    try:
        if getattr(arguments, "print_completion", None) is not None:
            print(completion(arguments.print_completion))
            return console.DONE
        return _run(arguments, program)
    except ValueError as error:
        console.complain(program, str(error))
        return console.UNUSABLE


def _run(arguments: argparse.Namespace, program: str) -> int:
    if arguments.host not in {LOOPBACK, "::1", "localhost"}:
        host = console.visible(arguments.host)
        print(f"{program.partition(' ')[0]}: the network reaches it at {host}", file=sys.stderr)
    with _ended_by_signals() as ended, _opened(arguments) as board:
        log = board.board.event_log
        named = threading.Event()
        if not arguments.quiet:
            log.listener = _printer(named, ended)
        print(console.visible(board.port), flush=True)
        named.set()
        gone = over = False
        # In slices: on Windows a wait without end cannot be interrupted.
        while not over and not gone:
            over = ended.wait(0.5)
            gone = not arguments.quiet and _reader_has_gone()
        log.listener = None
        totals = f"{pluralize(board.accepted, 'message')}, {board.rejects.total} rejected"
        print(totals, file=sys.stderr)
    return console.READER_GONE if gone else console.DONE


def _reader_has_gone() -> bool:
    """Return whether nobody can read the output. On Windows only the next line shows."""
    if sys.platform == "win32":
        return False
    try:
        output = sys.stdout.fileno()
    except OSError:  # it is no file
        return False
    poll = select.poll()
    poll.register(output, 0)
    return bool(poll.poll(0))


def _printer(named: threading.Event, ended: threading.Event) -> Callable[[str], None]:
    """Return a function that prints all lines, the name of the port first."""

    def show(line: str) -> None:
        named.wait()
        try:
            print(line, flush=True)
        except OSError:  # whoever read along has gone, and console.run tells the shell
            ended.set()

    return show


@contextmanager
def _opened(arguments: argparse.Namespace) -> Iterator[VirtualController]:
    """Open the port of a board. Raises ValueError if there cannot be such a port."""
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
        local_echo=arguments.local_echo,
        faults=faults_of(arguments),
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
    """Return an event that SIGINT and SIGTERM set, so that links and ports are always removed."""
    ended = threading.Event()
    kinds = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(kind, lambda *_: ended.set()) for kind in kinds]
    try:
        yield ended
    finally:
        for kind, handler in zip(kinds, before, strict=True):
            signal.signal(kind, handler)
