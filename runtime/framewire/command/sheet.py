"""A page of text for a terminal: headings, paragraphs and columns, as wide as it is."""

from __future__ import annotations

import shutil
from textwrap import wrap

from .colour import painted, takes_colour
from .console import visible, write_as_it_is

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import TextIO

# A line that is read with ease; one that there must be room for, as narrow as a terminal may be.
_WIDEST, _NARROWEST = 100, 40
# The least that the last column gets.
_LAST = 20


class Sheet:
    """Text on a screen, coloured and as wide as a terminal; plain and `_WIDEST` in a pipe."""

    def __init__(self, screen: TextIO) -> None:
        self._screen = screen
        self._colour = takes_colour(screen)
        columns = shutil.get_terminal_size().columns if screen.isatty() else _WIDEST
        self._width = max(_NARROWEST, min(columns, _WIDEST))
        self._begun = False

    def heading(self, text: str) -> None:
        """Print a heading, with an empty line above it unless it is the first."""
        if self._begun:
            self.line()
        self.line(text, "cyan")

    def line(self, text: str = "", colour: str = "") -> None:
        """Print a line as it is."""
        self._begun = True
        shown = visible(text)
        coloured = painted(shown, colour) if colour and self._colour else shown
        write_as_it_is(self._screen, f"{coloured}\n")

    def paragraph(self, text: str, indent: int = 0, colour: str = "") -> None:
        """Print text in lines that fit."""
        margin = " " * indent
        room = self._width - indent
        for line in wrap(visible(" ".join(text.split())), room, break_on_hyphens=False):
            self.line(margin + line, colour)

    def paragraphs(self, text: str) -> None:
        """Print paragraphs, which empty lines divide."""
        for paragraph in filter(None, text.split("\n\n")):
            self.line()
            self.paragraph(paragraph)

    def columns(self, rows: Sequence[tuple[str, ...]]) -> None:
        """Print columns, the last of which takes as many lines as it needs."""
        shown = [[visible(cell) for cell in row] for row in rows]
        widths = [max(map(len, column)) for column in zip(*shown, strict=True)][:-1]
        before = sum(widths) + 2 * len(widths) + 2
        room = max(_LAST, self._width - before)
        for *cells, last in shown:
            padded = (f"{cell:<{width}}" for cell, width in zip(cells, widths, strict=True))
            begin = "  ".join(["", *padded, ""])
            for piece in wrap(last, room, break_on_hyphens=False) or [""]:
                self.line(f"{begin}{piece}".rstrip())
                begin = " " * before
