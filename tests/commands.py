"""Commands called in this process, as a shell calls them."""

import io
import json
import sys
from collections.abc import Callable, Sequence
from contextlib import redirect_stderr, redirect_stdout
from typing import Any, NamedTuple
from unittest import mock

import busservo.__main__


class Ended(NamedTuple):
    """The exit status, the output and the errors of a command."""

    status: int
    out: str
    err: str


def called(
    main: Callable[[Sequence[str]], int], *words: str, given: bytes | str = b"", screen: str = ""
) -> Ended:
    """Call a command that reads these bytes, or this text, from standard input.

    With `screen`, both its streams are terminals of that TERM.
    """
    data = given.encode() if isinstance(given, str) else given
    streams = [_Stream(is_terminal=bool(screen)) for _ in range(2)]
    variables = {"TERM": screen} if screen else {}
    with (
        mock.patch.object(sys, "stdin", io.TextIOWrapper(io.BytesIO(data), encoding="utf-8")),
        mock.patch.dict("os.environ", variables),
        redirect_stdout(streams[0]),
        redirect_stderr(streams[1]),
    ):
        status = main(words)
    return Ended(status, *(each.text for each in streams))


def run(*words: object, given: bytes | str = b"", main: Any = busservo.__main__.main) -> Ended:
    """Call `busservo`, or the command of another library."""
    return called(main, *map(str, words), given=given)


def records(*words: object, **how: Any) -> list[Any]:
    """Return what `busservo` prints as lines of JSON; it has to end well."""
    ended = run(*words, **how)
    assert ended.status == 0, ended.err
    return [json.loads(line) for line in ended.out.splitlines()]


class Terminal(io.StringIO):
    """A terminal that keeps what is written."""

    def isatty(self) -> bool:
        return True


class _Stream(io.TextIOWrapper):
    """A stream that keeps what is written."""

    def __init__(self, *, is_terminal: bool) -> None:
        self._kept = io.BytesIO()
        self._is_terminal = is_terminal
        super().__init__(self._kept, encoding="utf-8", newline="\n", write_through=True)

    def isatty(self) -> bool:
        return self._is_terminal

    @property
    def text(self) -> str:
        self.flush()
        return self._kept.getvalue().decode()
