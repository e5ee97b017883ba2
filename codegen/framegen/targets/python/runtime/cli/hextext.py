"""Reads hex as people paste it: `55 55 02 07`, `0x55, 0x55`, `55550207`, over any lines."""

from __future__ import annotations

import re

from .unusable import UnusableError

# A line that says that nothing came for a while, so that a frame begun before it was given up.
QUIET = "# quiet"
# A comment runs from a `#` to the end of its line.
_SKIPPED = re.compile(r"#[^\n]*|0[xX]|\\x|[\s,;:_-]+")
_HEX_TEXT = re.compile(rb"(?:[0-9A-Fa-f]{2}|0[xX]|\\x|[\s,;:_-]|#[^\n]*)*")


def looks_like_hex(data: bytes) -> bool:
    """Whether bytes are hex written as text, rather than raw bytes."""
    return data.isascii() and bool(data.strip()) and _HEX_TEXT.fullmatch(data) is not None


def parse_hex(text: str) -> bytes:
    """The bytes that hex stands for. Raises UnusableError, naming what is no hex."""
    found = bytearray()
    for word in _SKIPPED.sub(" ", text).split():
        try:
            found += bytes.fromhex(word)
        except ValueError:
            wrong = next((c for c in word if c not in "0123456789abcdefABCDEF"), None)
            why = f"it has {len(word)} digits" if wrong is None else f"{wrong!r} is no hex digit"
            raise UnusableError(
                f"{word[:40]!r} is not hex: {why}; write two digits a byte, like 55 55 02"
            ) from None
    return bytes(found)
