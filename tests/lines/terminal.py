"""Run a verb as people do: in a process of its own, on a terminal of its own."""

from __future__ import annotations

import os
import pty
import re
import select
import subprocess
import sys
import termios
import time
from typing import TYPE_CHECKING, Any

from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from types import TracebackType

    from typing_extensions import Self

ENVIRONMENT = {
    **{name: value for name, value in os.environ.items() if name not in {"NO_COLOR", "COLUMNS"}},
    "PYTHONPATH": os.pathsep.join(filter(None, sys.path)),
    "TERM": "xterm",
}
_LOCAL_MODES = 3  # where tcgetattr has them
# What a shell does for its programs: the terminal becomes the one that sends SIGINT for Ctrl-C, and
# SIGINT does something, even where the tests themselves run in the background and ignore it.
# A wait is shown soon, as no test is about how long one goes on before that.
_PROGRAM = """
import fcntl, signal, sys, termios
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
signal.signal(signal.SIGINT, signal.default_int_handler)
from busservo.__main__ import main
from framewire.command import progress
progress.PROGRESS_INTERVAL = 0.02
sys.exit(main())
"""


class OnTerminal:
    """A verb on a terminal; to be used in a `with`, which ends it if nothing else did."""

    def __init__(self, *words: str, **environment: str) -> None:
        self.shown = ""
        self._screen, terminal = pty.openpty()
        modes = termios.tcgetattr(terminal)
        # Ctrl-C would discard what was printed and not yet read here, line ends and all.
        modes[_LOCAL_MODES] |= termios.NOFLSH
        termios.tcsetattr(terminal, termios.TCSANOW, modes)
        self._before = termios.tcgetattr(terminal)
        self._process = subprocess.Popen(
            [sys.executable, "-c", _PROGRAM, *words],
            stdin=terminal,
            stdout=terminal,
            stderr=terminal,
            env=ENVIRONMENT | environment,
            start_new_session=True,
        )
        # Kept open, so that what was printed last is not lost with the last who has it open.
        self._terminal = terminal

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._process.kill()
        self._process.wait()
        os.close(self._terminal)
        os.close(self._screen)

    def wait_for(self, pattern: str) -> None:
        """Read until the screen has shown a text."""
        until = time.monotonic() + GENEROUS
        while not re.search(pattern, self.shown):
            assert time.monotonic() < until, f"{pattern!r} was not shown: {self.shown!r}"
            self._read(0.1)

    def type(self, keys: bytes) -> None:
        os.write(self._screen, keys)

    def end(self) -> int:
        """Wait until it has ended, and return its exit status; the terminal must be as it was."""
        status = self._process.wait(GENEROUS)
        while self._read(0.0):
            pass
        assert termios.tcgetattr(self._terminal) == self._before
        return status

    def _read(self, seconds: float) -> bool:
        ready, _, _ = select.select([self._screen], [], [], seconds)
        if ready:
            self.shown += os.read(self._screen, 65536).decode()
        return bool(ready)

    @property
    def lines(self) -> list[str]:
        """The text on the screen, line by line: a carriage return overwrites."""
        return [_overwritten(line) for line in self.shown.split("\r\n")]


def _overwritten(line: str) -> str:
    seen: list[str] = []
    for part in line.split("\r"):
        seen[: len(part)] = part
    return "".join(seen).rstrip()


def start(*words: str, **options: Any) -> subprocess.Popen[str]:
    """Start a verb in a process of its own, to go on beside the test."""
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True} | options
    return subprocess.Popen([sys.executable, "-m", "busservo", *words], env=ENVIRONMENT, **options)
