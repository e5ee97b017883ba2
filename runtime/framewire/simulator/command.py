"""What the commands of all simulators do: open a port, print what happens, end by a signal."""

from __future__ import annotations

import select
import signal
import sys
import threading
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from ..command import console, shell_completion
from ..frame.pluralize import pluralize
from .line_options import (
    add_fault_arguments,
    add_line_arguments,
    add_output_arguments,
    completion,
    line_of,
    listed_faults,
    via,
)
from .tcp_end import LOOPBACK

if TYPE_CHECKING:
    import argparse
    from collections.abc import Callable, Iterator, Sequence

    from ..client.library import Library
    from .line_faults import LineFaults
    from .virtual_line import LineSettings, VirtualLine


# The lines of every help in front of a simulator's own: arguments, and what they give.
_EXAMPLES = (
    ("", "{noun} behind a pty, whose name is printed first"),
    ("--link COM7", "the same, by a name that you choose"),
    ("--tcp 4000", f"{{noun}} at socket://{LOOPBACK}:4000, on any system"),
    ("--baud inf", "quicker than the real line: bytes take no time"),
)
_AT_WORK = (
    "What happens is printed line by line: the seconds since the start, who, and what. "
    "Ctrl-C ends it."
)


@dataclass(frozen=True)
class Simulator:
    """The command of a simulator.

    `faults` are those that may happen to its line. `description` says what it is for, `noun` what
    it puts behind a port, `examples` are arguments with what they give, and `notes` are further
    sentences of the help. `declare` adds the options that say what the device is, and `make` makes
    it: at what kind of port, at which line, by these options.
    """

    name: str
    library: Library
    faults: type[LineFaults]
    description: str
    noun: str
    examples: tuple[tuple[str, str], ...]
    declare: Callable[[Any], None]
    make: Callable[[Literal["pty", "tcp"], LineSettings, argparse.Namespace], VirtualLine]
    notes: str = ""

    def main(self, argv: Sequence[str] | None = None, *, program: str = "") -> int:
        """Run a command line. 0: ended by Ctrl-C; 2: usage error; 141: its output has no reader.

        `program` is how the command was called, if not by its name: it is a verb of another one,
        too. With --quiet, nothing follows the name of the port, so its reader may leave.
        """
        called = program or self.name
        return console.run(called, lambda: self._run_or_complain(argv, called))

    def parser(self, program: str = "") -> argparse.ArgumentParser:
        """Return the parser of the command, under the name that it was called by."""
        called = program or self.name
        parser = console.Parser(
            prog=called, description=self.description, epilog=self._epilog(called)
        )
        self.add_arguments(parser)
        if called == self.name:
            shell_completion.add_option(parser)
        return parser

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the options of the command."""
        add_line_arguments(parser, self.library.link.baud)
        self.declare(parser.add_argument_group("what it is"))
        add_fault_arguments(parser, self.faults)
        add_output_arguments(parser, f"{self.name} {self.library.version}")

    def made_of(self, arguments: argparse.Namespace) -> VirtualLine:
        """Return the device at its line. Raises ValueError for what cannot be."""
        return self.make(via(arguments), line_of(arguments, self.faults), arguments)

    def _epilog(self, program: str) -> str:
        examples = [
            f"  {program} {words:<27}{what.format(noun=self.noun)}".rstrip()
            for words, what in (*_EXAMPLES, *self.examples)
        ]
        paced = f"at {self.library.link.baud} baud, unless --baud says otherwise."
        return "\n".join(
            [
                "examples:",
                *examples,
                "\nfaults, each by its chance from 0 to 1:",
                listed_faults(self.faults),
                f"\nBytes take as long as on the real line, {paced}",
                *filter(None, [self.notes]),
                f"\n{_AT_WORK}\n",
            ]
        )

    def _run_or_complain(self, argv: Sequence[str] | None, program: str) -> int:
        arguments = self.parser(program).parse_args(argv)
        try:
            shell = getattr(arguments, "print_completion", None)
            if shell is not None:
                print(completion(self.parser(), shell, self.faults))
                return console.DONE
            return _run(self.made_of(arguments), arguments, program)
        except ValueError as error:
            console.complain(program, str(error))
            return console.UNUSABLE


def _run(device: VirtualLine, arguments: argparse.Namespace, program: str) -> int:
    """Serve a device until a signal ends it. Raises ValueError for what cannot be opened."""
    with _ended_by_signals() as ended, _opened(device, arguments) as line:
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
