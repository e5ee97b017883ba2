"""Invisible characters: which a spec may not hold, and what is shown for them."""

from __future__ import annotations

import re

# Written as ranges of our own rather than taken from the Unicode database, which differs between
# Python versions: the same spec must give the same answer everywhere.
_RANGES = (
    (0x00, 0x09),
    (0x0B, 0x1F),
    (0x7F, 0x9F),
    (0xAD, 0xAD),
    (0x061C, 0x061C),
    (0x180E, 0x180E),
    (0x200B, 0x200F),
    (0x2028, 0x202E),
    (0x2060, 0x206F),
    (0xD800, 0xDFFF),
    (0xFE00, 0xFE0F),
    (0xFEFF, 0xFEFF),
    (0xFFF9, 0xFFFB),
    (0xE0000, 0xE0FFF),
)
_INVISIBLE = re.compile(f"[{''.join(f'{chr(low)}-{chr(high)}' for low, high in _RANGES)}]")


def is_invisible(character: str) -> bool:
    """Tell whether it is a control, a direction override or another character of no width."""
    return _INVISIBLE.match(character) is not None


def first_invisible(text: str) -> str | None:
    """Find the first character that may not occur in a spec; a line feed may."""
    found = _INVISIBLE.search(text)
    return None if found is None else found[0]


def shown(text: str) -> str:
    """Replace white space by blanks, and what is invisible by a mark, one for one."""
    return "".join(
        " " if c in "\t\n\r\v\f" else c if c.isprintable() else "\N{REPLACEMENT CHARACTER}"
        for c in text
    )
