"""Makes text from a spec safe for the place where it goes in Python source."""

from __future__ import annotations

import re
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING

from framegen.reading.text import is_invisible

if TYPE_CHECKING:
    from collections.abc import Sequence

WIDTH = 100
# A quote that stands first, last or before another could begin or end a docstring.
_RISKY_QUOTE = re.compile(r'\A"|"(?="|\Z)')


def literal(text: str) -> str:
    """`text` as a string literal, in the quotes that the formatter would choose."""
    quote = "'" if text.count('"') > text.count("'") else '"'
    return quote + "".join(_escaped(character, f"{quote}\\") for character in text) + quote


def prose(text: str) -> str:
    """`text` for the inside of a docstring: no quote can end it, no example in it be run."""
    folded = " ".join(text.split())
    safe = "".join(_escaped(character, "\\") for character in folded)
    # doctest runs what follows three of these, so prose must not be able to say them.
    return _RISKY_QUOTE.sub(r'\\"', safe.replace(">>>", "> > >"))


def docstring(blocks: list[str], indent: int, example: list[str] | None = None) -> str:
    """A docstring, quotes and all: a summary, then a paragraph for each further block.

    `example` goes to its end as it is: lines of Python that the generator wrote itself.
    """
    paragraphs = [part for block in blocks for part in block.split("\n\n") if part.strip()]
    first, *rest = [lines(paragraph, indent) for paragraph in paragraphs] or [[""]]
    margin = " " * indent
    if not rest and not example and len(first) == 1 and len(first[0]) <= WIDTH - indent - 6:
        return f'"""{first[0]}"""'
    body = [*first, *(line for paragraph in rest for line in ["", *paragraph])]
    body += ["", *example] if example else []
    text = "\n".join(f"{margin}{line}" if line else "" for line in body)
    return f'"""{text[indent:]}\n{margin}"""'


def lines(text: str, indent: int) -> list[str]:
    """Prose, wrapped to stand behind `indent` blanks, with room for the quotes of a docstring."""
    width = WIDTH - indent - 3
    return wrap(prose(text), width, break_long_words=False, break_on_hyphens=False)


@dataclass(frozen=True, slots=True)
class Bracketed:
    """A bracketed list of code: as text it is one line, and `fitted` breaks it where it must.

    `before` ends with the opening bracket and `after` begins with the closing one; `lone` follows a
    single item, as the comma of a tuple does.
    """

    before: str
    items: Sequence[str | Bracketed]
    after: str
    lone: str = ""

    def __str__(self) -> str:
        inside = ", ".join(map(str, self.items)) + (self.lone if len(self.items) == 1 else "")
        return f"{self.before}{inside}{self.after}"

    def fitted(self, indent: int, *, last: str = "") -> str:
        """On one line where it fits, `last` included, or else an item a line: as formatters do."""
        whole = str(self)
        if indent + len(whole) + len(last) <= WIDTH:
            return whole
        margin = " " * indent
        lines = [
            item if isinstance(item, str) else item.fitted(indent + 4, last=",")
            for item in self.items
        ]
        return "\n".join(
            [self.before, *(f"{margin}    {line}," for line in lines), f"{margin}{self.after}"]
        )


def session(call: Bracketed, indent: int) -> list[str]:
    """A call as lines of an interactive session that stand behind `indent` blanks."""
    first, *others = call.fitted(indent + len(">>> ")).split("\n")
    return [f">>> {first}", *(f"... {line[indent + len('... ') :]}" for line in others)]


def _escaped(character: str, special: str) -> str:
    if character in special:
        return "\\" + character
    if character == "\n":
        return "\\n"
    if not is_invisible(character):
        return character
    code = ord(character)
    return (
        f"\\x{code:02x}"
        if code < 0x100
        else f"\\u{code:04x}"
        if code < 0x10000
        else f"\\U{code:08x}"
    )
