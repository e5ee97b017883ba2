"""The addresses of message pages."""

from __future__ import annotations

from framegen.targets.filenames import file_stem


def message_page(name: str) -> str:
    """Return the page of a message from the root of the reference, without its suffix."""
    return f"messages/{file_stem(name)}"
