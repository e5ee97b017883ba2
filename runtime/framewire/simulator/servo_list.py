"""Servo numbers as they are written on a command line: `1-6,9`."""

from __future__ import annotations


def parse_servos(text: str) -> list[int]:
    """Return the numbers, in order. Raises ValueError."""
    found: list[int] = []
    for part in text.split(","):
        first, _, last = part.partition("-")
        numbers = range(int(first), int(last or first) + 1)
        if not numbers or numbers[0] < 0 or numbers[-1] > 253:
            raise ValueError(f"{part!r} names no servo: servos are numbered 0 to 253")
        found.extend(numbers)
    return found
