"""The text of a spec file, and the places in it that findings point at."""

from __future__ import annotations

from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import PurePath
from typing import NamedTuple


class Span(NamedTuple):
    """A stretch of one line of the text; `line` and `column` count from 1."""

    line: int
    column: int
    length: int = 1


@dataclass(frozen=True, slots=True)
class Source:
    """A spec as text. `name` is the path as its reader gave it.

    `path` is its place below the root of its project: spec/NAME, or NAME for a spec that lies in no
    folder `spec`. If not given, it follows from the name.
    """

    name: str
    text: str
    path: str = ""
    lines: list[str] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "lines", self.text.split("\n"))
        if not self.path:
            object.__setattr__(self, "path", below_root(PurePath(self.name)))

    @property
    def digest(self) -> str:
        """The SHA-256 of the text with LF line ends, the same for a checkout on any platform."""
        return sha256(self.text.encode()).hexdigest()

    def line(self, number: int) -> str:
        """Return line `number`, counted from 1; empty past the end of the text."""
        return self.lines[number - 1] if 0 < number <= len(self.lines) else ""


def below_root(file: PurePath) -> str:
    """Return the path of a spec below the root of its project: the folder that holds spec/."""
    return f"spec/{file.name}" if file.parent.name == "spec" else file.name
