"""One line of progress on a terminal, cleared before anything else is printed."""

from __future__ import annotations

import os

from .console import visible, write_as_it_is

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TextIO

# How long a wait goes on before it is shown, and how often that changes.
PROGRESS_INTERVAL = 1.0


class Progress:
    """The line that says that a wait goes on. Without a terminal, it says nothing."""

    def __init__(self, screen: TextIO) -> None:
        self._screen = screen
        self._shown = ""
        self.seen = screen.isatty()

    def show(self, text: str) -> None:
        """Show a text, in place of the one before."""
        if not self.seen:
            return
        # A line that is longer than the terminal is wide could not be cleared, nor ^C behind it.
        text = visible(text)[: _columns(self._screen) - 1 - len("^C")]
        if text != self._shown:
            blank = " " * (len(self._shown) - len(text))
            self._shown = text
            # A carriage return and spaces: every terminal knows these, with escapes or without.
            self._write(f"\r{text}{blank}")

    def clear(self) -> None:
        """Clear the text."""
        if self._shown:
            self.end()

    def end(self) -> None:
        """Clear the line even if nothing was shown: a terminal may have printed ^C there."""
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
