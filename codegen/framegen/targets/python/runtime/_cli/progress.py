"""One line on a terminal that says how far something is, gone before anything else is printed."""

from __future__ import annotations

import os

from .console import visible, write_as_it_is

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TextIO

# How long a wait may be before it is worth a word, and how often the word changes.
PROGRESS_INTERVAL = 1.0


class Progress:
    """The line that says that a wait goes on. Where there is no terminal, it says nothing."""

    def __init__(self, screen: TextIO) -> None:
        self._screen = screen
        self._shown = ""
        self.seen = screen.isatty()

    def show(self, text: str) -> None:
        """Says it, in place of what was said before."""
        if not self.seen:
            return
        # A line that is longer than the terminal is wide could not be taken back.
        text = visible(text)[: _columns(self._screen) - 1]
        if text != self._shown:
            blank = " " * (len(self._shown) - len(text))
            self._shown = text
            # A carriage return and spaces: every terminal knows these, escapes or no.
            self._write(f"\r{text}{blank}")

    def clear(self) -> None:
        """Takes back what was said."""
        if self._shown:
            self.end()

    def end(self) -> None:
        """Clears the line even if nothing was said: a terminal has shown ^C there, perhaps."""
        if self.seen:
            self._write(f"\r{' ' * (len(self._shown) + len('^C'))}\r")
            self._shown = ""

    def _write(self, text: str) -> None:
        write_as_it_is(self._screen, text)
        self._screen.flush()


def _columns(screen: TextIO) -> int:
    try:
        # A terminal that does not know its size says 0.
        return os.get_terminal_size(screen.fileno()).columns or 80
    except (OSError, ValueError):
        return 80
