"""Words for numbers of things."""

from __future__ import annotations


def counted(number: int, noun: str, plural: str = "") -> str:
    """Count things: `1 finding`, `2 findings`; `plural` for a noun that takes no s."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"
