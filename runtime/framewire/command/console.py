"""Standard streams and exit status of a command; the same for every command.

What is printed may hold names that others chose (of ports, of files, in a spec), and these must not
control the terminal. A stream may be closed or full, or its reader may be gone: status and error
are then the same whether or not Python buffers the output.
"""

from __future__ import annotations

import argparse
import errno
import io
import os
import sys
from contextlib import contextmanager, suppress

from ..frame.visible import visible, visible_lines

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from typing import Any, NoReturn, TextIO, TypeVar

    Result = TypeVar("Result")

__all__ = [
    "DONE",
    "INTERRUPTED",
    "READER_GONE",
    "UNUSABLE",
    "Parser",
    "Screen",
    "complain",
    "run",
    "table",
    "visible",
    "write_as_it_is",
]

DONE, UNUSABLE = 0, 2
# The widest line of a table.
_WIDTH = 100
# What a shell reports for a program that SIGINT or SIGPIPE ended.
INTERRUPTED, READER_GONE = 130, 141


def complain(program: str, message: str, hint: str = "", *, choices: Iterable[str] = ()) -> None:
    """Print an error as every command does: a line for what is wrong, and one for the way out.

    `choices` are what could be typed instead, a line each. `program` may go on with a verb, which
    is left out.
    """
    print(f"{program.partition(' ')[0]}: error: {visible(message)}", file=sys.stderr)
    for choice in choices:
        print(f"  {visible(choice)}", file=sys.stderr)
    if hint:
        print(f"  hint: {visible(hint)}", file=sys.stderr)


def table(title: str, entries: Iterable[tuple[str, str]]) -> str:
    """Format two columns; where that is too wide to read, put the second below the first."""
    rows = list(entries)
    width = max((len(left) for left, _ in rows), default=0)
    lines = [f"  {left:<{width}}  {right}" for left, right in rows] or ["  none"]
    if any(len(line) > _WIDTH for line in lines):
        lines = [line for left, right in rows for line in (f"  {left}", f"      {right}")]
    return "\n".join([f"{title}:", *lines])


class Parser(argparse.ArgumentParser):
    """A command-line parser that reports errors in one line, and where to find help."""

    def __init__(self, **options: Any) -> None:
        options.setdefault("formatter_class", argparse.RawDescriptionHelpFormatter)
        super().__init__(allow_abbrev=False, **options)
        # From Python 3.14 on, help has colours of its own unless it is told otherwise.
        self.color = False

    def error(self, message: str) -> NoReturn:
        """Report the error, and exit with UNUSABLE."""
        complain(self.prog, message, f"`{self.prog} --help` shows how it is used")
        raise SystemExit(UNUSABLE)


def run(program: str, body: Callable[[], int]) -> int:
    """Run a command on safe streams, and return its exit status.

    `body` returns a status or raises SystemExit. When the output cannot be written, that decides
    the status: READER_GONE for a closed pipe, UNUSABLE with an error for everything else.
    """
    if isinstance(sys.stdout, Screen):  # a command within a command
        return body()
    with _standard_streams() as output:
        try:
            try:
                status = body()
            except SystemExit as stop:  # argparse has printed what there was to say
                status = stop.code if isinstance(stop.code, int) else DONE
            output.flush()
        except KeyboardInterrupt:
            # The terminal has shown ^C: what comes next begins a line of its own.
            if sys.stderr.isatty():
                print(file=sys.stderr)
            status = INTERRUPTED
        except OSError as error:
            status = _failed(program, error, output)
    return status


def _failed(program: str, error: OSError, output: Screen) -> int:
    why = error.strerror or str(error)
    if output.error is None:
        complain(program, why if error.filename is None else f"{error.filename}: {why}")
        return UNUSABLE
    if _reader_has_gone(output.error):
        return READER_GONE
    complain(program, f"the output cannot be written: {output.error.strerror or output.error}")
    return UNUSABLE


def _reader_has_gone(error: OSError) -> bool:
    # Windows calls a pipe without a reader an invalid argument.
    invalid = sys.platform == "win32" and error.errno == errno.EINVAL
    return invalid or isinstance(error, BrokenPipeError)


@contextmanager
def _standard_streams() -> Iterator[Screen]:
    """Put Screens in place of stdout and stderr."""
    _occupy_descriptors()
    before = sys.stdin, sys.stdout, sys.stderr
    # Where a stream was closed when the command began, Python has None.
    sys.stdin = before[0] or io.TextIOWrapper(io.BufferedReader(_Closed("standard input")))
    output = Screen(before[1] or _no_output("standard output"))
    replaced: Any = sys
    replaced.stdout = output
    replaced.stderr = Screen(before[2] or _no_output("standard error"), vital=False)
    try:
        yield output
    finally:
        output.end()
        sys.stdin, sys.stdout, sys.stderr = before


def _no_output(name: str) -> TextIO:
    unbuffered: Any = _Closed(name)
    return io.TextIOWrapper(unbuffered, write_through=True)


def _occupy_descriptors() -> None:
    """Open closed descriptors of 0, 1 and 2, so that no port gets such a number."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


class Screen:
    """A text stream that escapes invisible characters, and remembers why a write failed.

    `error` is the first failure of a vital stream; writing raises it, then and ever after. A stream
    that is not vital loses what cannot be written.
    """

    def __init__(self, stream: Any, *, vital: bool = True) -> None:
        self.stream = stream
        self.error: OSError | None = None
        self._vital = vital

    def __getattr__(self, name: str) -> Any:
        """Return any other attribute of the stream behind it."""
        return getattr(self.stream, name)

    @property
    def buffer(self) -> _Bytes:
        """The same stream for bytes, which are written as they are."""
        return _Bytes(self)

    def write(self, text: str) -> int:
        """Write text, with escapes in place of what is invisible or not in the encoding."""
        self.write_as_it_is(visible_lines(text))
        return len(text)

    def write_as_it_is(self, text: str) -> None:
        """Write text that may control the terminal: colours, or a line written over."""
        if not text.isascii():
            encoding = getattr(self.stream, "encoding", None) or "utf-8"
            text = text.encode(encoding, "backslashreplace").decode(encoding)
        self.attempt(lambda: self.stream.write(text))

    def flush(self) -> None:
        """Write what is still buffered."""
        self.attempt(self.stream.flush)

    def attempt(self, write: Callable[[], Result]) -> Result | None:
        """Write by a function, unless an earlier write has failed."""
        if self.error is None:
            try:
                return write()
            except OSError as error:
                self.error = error
        if self._vital:
            raise self.error
        return None

    def end(self) -> None:
        """Empty the buffer, so that the interpreter does not fail on it at exit."""
        with suppress(OSError):
            self.flush()
        if self.error is not None:
            nowhere = os.open(os.devnull, os.O_WRONLY)
            with suppress(OSError, ValueError):  # it is no file, and fails on nothing
                os.dup2(nowhere, self.stream.fileno())
            os.close(nowhere)


class _Bytes:
    """The type of `Screen.buffer`."""

    def __init__(self, screen: Screen) -> None:
        self._screen = screen

    def write(self, data: bytes) -> None:
        """Write bytes."""
        self._screen.attempt(lambda: self._screen.stream.buffer.write(data))

    def flush(self) -> None:
        """Write what is still buffered."""
        self._screen.flush()


def write_as_it_is(screen: TextIO | Screen, text: str) -> None:
    """Write our own text that controls the terminal, on a Screen or any other stream."""
    getattr(screen, "write_as_it_is", screen.write)(text)


class _Closed(io.RawIOBase):
    """A standard stream that was closed when the command began: using it raises OSError."""

    def __init__(self, name: str) -> None:
        self._name = name

    def readable(self) -> bool:
        """Return True, so that reading is tried and raises the error."""
        return True

    def writable(self) -> bool:
        """Return True, as for `readable`."""
        return True

    def readinto(self, _buffer: Any, /) -> int:
        """Raise OSError."""
        raise self._error()

    def write(self, _data: Any, /) -> int:
        """Raise OSError."""
        raise self._error()

    def _error(self) -> OSError:
        return OSError(errno.EBADF, "it is closed", self._name)
