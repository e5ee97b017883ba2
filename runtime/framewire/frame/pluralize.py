"""Numbers in words: how many there are of something, and which."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence


def pluralize(number: int, noun: str, plural: str = "") -> str:
    """Count things: `1 finding`, `2 findings`; `plural` for a noun that takes no s."""
    return f"{number} {noun if number == 1 else plural or noun + 's'}"


def describe_range(values: Sequence[int]) -> str:
    """Describe numbers: `5`, `4..255`, `8, 11, 14 .. 254`, or `2 or 4` where they are no range."""
    if not isinstance(values, range):
        return " or ".join(map(str, values))
    if len(values) <= 4:
        return ", ".join(str(value) for value in values)
    if values.step == 1:
        return f"{values[0]}..{values[-1]}"
    return f"{values[0]}, {values[1]}, {values[2]} .. {values[-1]}"
