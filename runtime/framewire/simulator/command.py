"""What the commands of all simulators do: open a port, print what happens, end by a signal."""

from __future__ import annotations

import select
import signal
import sys
import threading
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from ..command import console
from ..frame.pluralize import pluralize
from .line_options import completion
from .tcp_end import LOOPBACK

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterator, Sequence

    from .line_faults import LineFaults
    from .virtual_line import VirtualLine


@dataclass(frozen=True)
class Simulator:
    """A command: its name, its parser by the name it was called by, its faults, and its device."""

    name: str
    parser_of: Callable[[str], argparse.ArgumentParser]
    faults: type[LineFaults]
    make: Callable[[argparse.Namespace], VirtualLine]


def main(simulator: Simulator, argv: Sequence[str] | None, program: str) -> int:
    """Run a command line. 0: ended by Ctrl-C; 2: usage error; 141: the reader of its output left.

    With --quiet, nothing follows the name of the port, so its reader may leave.
    """
    return console.run(program, lambda: _run_or_tell(simulator, argv, program))


def _run_or_tell(simulator: Simulator, argv: Sequence[str] | None, program: str) -> int:
    arguments = simulator.parser_of(program).parse_args(argv)
    try:
        shell = getattr(arguments, "print_completion", None)
        if shell is not None:
            print(completion(simulator.parser_of(simulator.name), shell, simulator.faults))
            return console.DONE
        return _run(simulator.make, arguments, program)
    except ValueError as error:
        console.complain(program, str(error))
        return console.UNUSABLE


def _run(
    make: Callable[[argparse.Namespace], VirtualLine], arguments: argparse.Namespace, program: str
) -> int:
    """Serve what `make` makes until a signal ends it. Raises ValueError for what cannot be."""
    with _ended_by_signals() as ended, _opened(make(arguments), arguments) as line:
        log = line.log
        named = threading.Event()
        if not arguments.quiet:
            log.listener = _printer(named, ended)
        if via(arguments) == "tcp" and arguments.host not in {LOOPBACK, "::1", "localhost"}:
            host = console.visible(arguments.host)
            print(f"{program.partition(' ')[0]}: the network reaches it at {host}", file=sys.stderr)
        print(console.visible(line.port), flush=True)
        named.set()
        gone = over = False
        # In slices: on Windows a wait without end cannot be interrupted.
        while not over and not gone:
            over = ended.wait(0.5)
            gone = not arguments.quiet and _reader_has_gone()
        log.listener = None
        totals = f"{pluralize(line.accepted, 'message')}, {line.rejected} rejected"
        print(totals, file=sys.stderr)
    return console.READER_GONE if gone else console.DONE


def via(arguments: argparse.Namespace) -> Literal["pty", "tcp"]:
    """Return what kind of port is asked for. Raises ValueError for a link without a pty."""
    if arguments.tcp is None and sys.platform != "win32":
        return "pty"
    if arguments.link is not None:
        raise ValueError("--link names a pty, and there is none with --tcp")
    return "tcp"


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
def _opened(line: VirtualLine, arguments: argparse.Namespace) -> Iterator[VirtualLine]:
    """Open a port. Raises ValueError if there cannot be such a port."""
    with ExitStack() as port:
        try:
            port.enter_context(line)
        except OSError as error:
            where = "a pty" if arguments.link is None else f"the link {arguments.link!r}"
            if via(arguments) == "tcp":
                where = f"{arguments.host}, port {arguments.tcp or 0}"
            raise ValueError(f"{where} cannot be opened: {error.strerror or error}") from None
        yield line


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
