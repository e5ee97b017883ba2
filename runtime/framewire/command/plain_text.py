"""Text among the bytes of a line: what another device prints, shown as it was meant."""

from __future__ import annotations

from .console import visible

_LONGEST = 60
# So many characters that differ: the bytes of a header, over and over, are none.
_LEAST = 4
_BLANKS = "\t\r\n"


def plain_text(data: bytes) -> str:
    """Return the text that bytes are, in quotes and on one line; empty if they are no text.

    One character in ten may be damaged. Of a longer text, this is the beginning.
    """
    text = data.decode("utf-8", errors="replace")
    damaged = sum(not _is_printed(character) for character in text)
    if len({*text}) < _LEAST or text.isspace() or 10 * damaged > len(text):
        return ""
    text = text.strip()
    return f'"{visible(text[:_LONGEST])}{"..." if len(text) > _LONGEST else ""}"'


def _is_printed(character: str) -> bool:
    return (character.isprintable() or character in _BLANKS) and character != "\ufffd"
