"""A program that answers questions: started, asked line by line, and ended with its children.

Nothing that it does blocks the caller: what it prints is always read, what it does not read waits
in a thread, and an answer is limited in time and in size.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from dataclasses import dataclass
from queue import SimpleQueue
from threading import Condition, Thread
from typing import IO, TYPE_CHECKING, Any

from framewire.frame.pluralize import pluralize

from framegen.conformance.language import END
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Sequence

# An answer may have so many bytes, and so many more for each character of its question: a line for
# each byte that was sent is far from it.
_ROOM, _ROOM_EACH = 100_000, 60
# What is kept of the errors that it prints.
_LAST_WORDS = 2_000
# How long a program may take to end by itself, and how long until it shows that it has ended.
_ENDING, _NOTICING = 2.0, 2.0
_PIECE = 65_536


@dataclass(frozen=True, slots=True)
class Reply:
    """The lines of an answer, without the `end`; `failure` says why no `end` came, if none did.

    `hangs` is true where that is because it ran out of time.
    """

    lines: tuple[str, ...]
    failure: str = ""
    hangs: bool = False


class Program:
    """A command line that is started by a question, and again after it has failed.

    `last_words` is the end of what it printed on its error stream before it ended.
    """

    def __init__(self, command: Sequence[str], timeout: float) -> None:
        self.command = list(command)
        self.timeout = timeout
        self.last_words = ""
        self._running: _Running | None = None

    def ask(self, question: str, timeout: float | None = None) -> Reply:
        """Ask in one line, and wait for the answer. Raises Unusable if it cannot be started."""
        if self._running is None:
            self._running = _Running(self.command)
        reply = self._running.ask(question, timeout or self.timeout)
        if reply.failure:
            self._end(timeout=0)
        return reply

    def close(self) -> None:
        """End the program with its children; the next question starts it again."""
        self._end(timeout=_ENDING)

    def _end(self, timeout: float) -> None:
        if self._running is not None:
            self._running.end(timeout)
            self.last_words = self._running.last_words
            self._running = None


class _Running:
    """One process, and the threads at its pipes."""

    def __init__(self, command: Sequence[str]) -> None:
        try:
            # Unbuffered, as nobody may wait for a lock that a thread holds while it reads.
            self._process = subprocess.Popen(  # noqa: S603 - to be run is what it was named for
                command,
                bufsize=0,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                start_new_session=True,
            )
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or str(error)
            hint = "name a program that is on the path, or give its path, like ./codec"
            raise Unusable(f"`{command[0]}` cannot be started: {why}", hint=hint) from None
        self._questions: SimpleQueue[bytes | None] = SimpleQueue()
        self._output = _Output()
        self._said: bytes = b""
        self._threads = [
            Thread(target=work, args=[pipe], daemon=True)
            for work, pipe in (
                (self._write, self._process.stdin),
                (self._read, self._process.stdout),
                (self._listen, self._process.stderr),
            )
        ]
        for thread in self._threads:
            thread.start()

    def ask(self, question: str, timeout: float) -> Reply:
        deadline = time.monotonic() + timeout
        self._output.allow(_ROOM + _ROOM_EACH * len(question))
        self._questions.put(f"{question}\n".encode())
        lines: list[str] = []
        while True:
            line = self._output.line(deadline)
            if line is None:
                hangs = not (self._output.closed or self._output.too_much)
                return Reply(tuple(lines), self._why(timeout, len(lines), hangs=hangs), hangs)
            text = line.decode("utf-8", "backslashreplace").strip()
            if text == END:
                return Reply(tuple(lines))
            lines.append(text)

    def _why(self, timeout: float, lines: int, *, hangs: bool) -> str:
        """Return why no `end` came."""
        after = f"after {pluralize(lines, 'line')}" if lines else "before it printed a line"
        if self._output.too_much:
            return f"it prints on and on: {self._output.room} bytes without an `end`"
        if hangs:
            hint = "" if lines else "; does it flush its output behind each `end`?"
            return f"no `end` came within {timeout:g} s, {after}{hint}"
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(_NOTICING)
        status = self._process.poll()
        if status is None:
            return f"it closed its output {after}"
        if status < 0:
            with suppress(ValueError):
                return f"it was ended by {signal.Signals(-status).name} {after}"
        return f"it ended with status {status} {after}"

    @property
    def last_words(self) -> str:
        return self._said.decode("utf-8", "backslashreplace").strip()

    def end(self, timeout: float) -> None:
        """Let it end by itself once there are no more questions, or end it by force."""
        self._questions.put(None)
        if timeout:
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(timeout)
        self._kill()
        self._process.wait()
        for thread in self._threads:
            thread.join(_NOTICING)
        for thread, pipe in zip(self._threads, self._pipes(), strict=True):
            if not thread.is_alive():  # or else somebody who got away still has the other end
                with suppress(OSError):
                    pipe.close()

    def _pipes(self) -> list[IO[bytes]]:
        process: Any = self._process
        return [process.stdin, process.stdout, process.stderr]

    def _kill(self) -> None:
        if sys.platform == "win32":
            tree = ["taskkill", "/F", "/T", "/PID", str(self._process.pid)]
            with suppress(OSError):
                subprocess.run(tree, capture_output=True, check=False)  # noqa: S603 - our own words
            with suppress(OSError):
                self._process.kill()
        else:
            # It leads a group of its own. macOS does not permit to end what has ended.
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)

    # The threads at its pipes.

    def _write(self, pipe: IO[bytes]) -> None:
        while (question := self._questions.get()) is not None:
            left = memoryview(question)
            try:
                while left:
                    left = left[pipe.write(left) :]
            except (OSError, ValueError):
                break  # it has ended or closed its input, which shows in what it prints
        with suppress(OSError):
            pipe.close()

    def _read(self, pipe: IO[bytes]) -> None:
        with suppress(OSError, ValueError):
            while piece := pipe.read(_PIECE):
                self._output.add(piece)
        self._output.close()

    def _listen(self, pipe: IO[bytes]) -> None:
        with suppress(OSError, ValueError):
            while piece := pipe.read(_PIECE):
                self._said = (self._said + piece)[-_LAST_WORDS:]


class _Output:
    """The output of a program: one thread adds to it, and another takes the lines."""

    def __init__(self) -> None:
        self.closed = False
        self.too_much = False
        self.room = 0
        self._left = 0
        self._lines = bytearray()
        self._change = Condition()

    def allow(self, room: int) -> None:
        """Take so many bytes, and no more, until more are allowed."""
        with self._change:
            self.room = self._left = room

    def add(self, piece: bytes) -> None:
        with self._change:
            self._left -= len(piece)
            self.too_much = self.too_much or self._left < 0
            if not self.too_much:
                self._lines += piece
            self._change.notify_all()

    def close(self) -> None:
        with self._change:
            self.closed = True
            self._change.notify_all()

    def line(self, deadline: float) -> bytes | None:
        """Return the next line; None where there is none, or none in time."""
        with self._change:
            while (end := self._lines.find(b"\n")) < 0:
                left = deadline - time.monotonic()
                if self.closed or self.too_much or left <= 0:
                    return None
                self._change.wait(left)
            found = bytes(self._lines[:end])
            del self._lines[: end + 1]
            return found
