"""Colours on terminals: none for a pipe, a file, or where NO_COLOR is set."""

from __future__ import annotations

import os
import sys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TextIO

_SGR = {"red": 31, "green": 32, "yellow": 33, "magenta": 35, "cyan": 36}


def takes_colour(screen: TextIO) -> bool:
    """Tell whether `screen` shows colours; see https://no-color.org."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb" or not screen.isatty():
        return False
    # The console that came with Windows shows the escapes themselves, unless it was told otherwise.
    return sys.platform != "win32" or "WT_SESSION" in os.environ or "TERM" in os.environ


def painted(text: str, colour: str) -> str:
    """Return text with the escapes of a colour around it."""
    return f"\x1b[{_SGR[colour]}m{text}\x1b[0m"
