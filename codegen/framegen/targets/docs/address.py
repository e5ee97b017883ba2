"""Where the page of a message lies."""

from __future__ import annotations

from framegen.targets.filenames import file_stem


def message_page(name: str) -> str:
    """The page of a message, from the root of the reference, whatever it is written in."""
    return f"messages/{file_stem(name)}"
