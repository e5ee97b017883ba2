"""The text of a spec file, and places in it: what every finding points at."""

from __future__ import annotations

from dataclasses import dataclass, field
from hashlib import sha256


@dataclass(frozen=True, slots=True, order=True)
class Span:
    """A stretch of one line of the text; `line` and `column` count from 1."""

    line: int
    column: int
    length: int = 1


@dataclass(frozen=True, slots=True)
class Source:
    """A spec as text. `name` is how its reader knows it: the path as it was given."""

    name: str
    text: str
    lines: list[str] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "lines", self.text.split("\n"))

    @property
    def digest(self) -> str:
        """SHA-256 of the text with LF line ends, so that a checkout on any platform agrees."""
        return sha256(self.text.encode()).hexdigest()

    def line(self, number: int) -> str:
        """Line `number`, counted from 1; empty past the end of the text."""
        return self.lines[number - 1] if 0 < number <= len(self.lines) else ""
