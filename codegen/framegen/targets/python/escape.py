"""Escaping of text of a spec for Python code, and line breaks of code."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from framegen.targets.python.characters import columns, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

WIDTH = 100
# Linters take these for a file that others can write to, or for a server that is open to all.
_ALARMING = re.compile(r"/(?:var/)?tmp|/dev/shm|0\.0\.0\.0\Z")
_WORD = re.compile(r"\s*\S*")


def literal(text: str) -> str:
    """Return `text` as a string literal, in the quotes that the formatter would choose."""
    quote, other = "'\"" if text.count('"') > text.count("'") else "\"'"
    if _ALARMING.match(text):
        rest = text[1:].replace("{", "{{").replace("}", "}}")
        return f"f{quote}{{{other}{text[0]}{other}}}{_inside(rest, quote)}{quote}"
    return f"{quote}{_inside(text, quote)}{quote}"


def byte_literal(data: bytes) -> str:
    """Return bytes as a literal, each as an escape."""
    return 'b"' + "".join(f"\\x{byte:02x}" for byte in data) + '"'


def assigned(text: str, name: str, indent: int) -> str:
    """Return the assignment of a text to `name`, in brackets where it takes several lines."""
    line = f"{name} = {literal(text)}"
    if indent + columns(line) <= WIDTH:
        return line
    margin = " " * indent
    inside = Text(text).fitted(indent + 4)
    return f"{name} = (\n{margin}    {inside}\n{margin})"


def argument(text: str, name: str) -> str:
    """Return a text as the argument `name` of a call, in brackets where it takes several lines."""
    return Text(text, before=f"{name}=", item=True).fitted(4, last=",")


# A part of code: text as it is, or what can be broken.
Part: TypeAlias = "str | Text | Sum | Bracketed"


@dataclass(frozen=True, slots=True)
class Text:
    """A text as a literal, between `before` and `after`: several where it is too long for a line.

    Those of an `item` of a tuple, a dict or a call stand in brackets, lest one take them for items.
    """

    text: str
    before: str = ""
    after: str = ""
    item: bool = False

    def __str__(self) -> str:
        return f"{self.before}{literal(self.text)}{self.after}"

    def fitted(self, indent: int, *, last: str = "") -> str:
        """Format it on one line where it fits, `last` included, or else a literal a line."""
        if indent + columns(str(self)) + len(last) <= WIDTH:
            return str(self)
        margin = "\n" + " " * indent
        if self.item:
            inside = Text(self.text).fitted(indent + 4)
            return f"{self.before}({margin}    {inside}{margin}){self.after}"
        room = WIDTH - indent - len(self.after) - len(last)
        pieces = _pieces(self.text, room - len(self.before), room)
        return f"{self.before}{margin.join(map(literal, pieces))}{self.after}"


def _pieces(text: str, first: int, others: int) -> list[str]:
    """Cut `text` into literals that fit into so many columns, between words where it can be."""
    pieces = [""]
    room = first
    for word in _WORD.findall(text):
        for part in [word] if columns(literal(word)) <= room else word:
            if columns(literal(pieces[-1] + part)) > room:
                pieces.append("")
                room = others
            pieces[-1] += part
    return pieces


@dataclass(frozen=True, slots=True)
class Sum:
    """Terms with a plus between, or another sign: a line each where they are too long for one."""

    terms: Sequence[str]
    sign: str = "+"

    def __str__(self) -> str:
        return f" {self.sign} ".join(self.terms)

    def fitted(self, indent: int, *, last: str = "") -> str:
        """Format it on one line where it fits, `last` included, or else a term a line."""
        fits = indent + columns(str(self)) + len(last) <= WIDTH
        return str(self) if fits else f"\n{' ' * indent}{self.sign} ".join(self.terms)


@dataclass(frozen=True, slots=True)
class Bracketed:
    """A bracketed list of code: as text it is one line, and `fitted` breaks it where it must.

    `before` ends with the opening bracket and `after` begins with the closing one; `lone` follows a
    single item, as the comma of a tuple does. `comma` is what follows the last item on a line of
    its own: nothing where that would make a tuple of it.
    """

    before: str
    items: Sequence[Part]
    after: str
    lone: str = ""
    comma: str = ","

    def __str__(self) -> str:
        inside = ", ".join(map(str, self.items)) + (self.lone if len(self.items) == 1 else "")
        return f"{self.before}{inside}{self.after}"

    def fitted(self, indent: int, *, last: str = "") -> str:
        """Format it on one line where it fits, `last` included, or else an item a line."""
        whole = str(self)
        if not self.items or indent + columns(whole) + len(last) <= WIDTH:
            return whole
        margin = " " * indent
        lines = [
            f"{item}{self.comma}"
            if isinstance(item, str)
            else item.fitted(indent + 4, last=self.comma) + self.comma
            for item in self.items
        ]
        return "\n".join(
            [self.before, *(f"{margin}    {line}" for line in lines), f"{margin}{self.after}"]
        )


def session(call: Bracketed, indent: int) -> list[str]:
    """Return a call as lines of an interactive session that are indented by `indent`."""
    first, *others = call.fitted(indent + len(">>> ")).split("\n")
    return [f">>> {first}", *(f"... {line[indent + len('... ') :]}" for line in others)]


def _inside(text: str, quote: str) -> str:
    safe = text.replace("\\", "\\\\").replace(quote, f"\\{quote}").replace("\n", "\\n")
    return shown(safe)


def quoted(text: str) -> str:
    """Return text as a basic string of TOML, which escapes characters as JSON does."""
    return json.dumps(" ".join(text.split()), ensure_ascii=False)
