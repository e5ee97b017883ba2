"""What can be said against a spec: a rule, a place, what is wrong there and how to mend it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.reading.source import Source, Span


@dataclass(frozen=True, slots=True)
class Related:
    """A second place that a finding speaks of, such as the first use of a duplicate."""

    span: Span
    text: str


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing wrong with a spec.

    `rule` is the stable id; `path` the dotted path of the value (`messages.ServoMove.id`).
    What `message` and `hint` repeat of the spec is cut short where nobody would read all of it.
    """

    rule: str
    span: Span
    path: str
    message: str
    hint: str = ""
    related: tuple[Related, ...] = ()

    def __post_init__(self) -> None:
        object.__setattr__(self, "message", _shortened(self.message))
        object.__setattr__(self, "hint", _shortened(self.hint))

    def render(self, source: Source) -> str:
        """Show the finding as a person reads it: place, rule, source line, caret, hint."""
        return "\n".join(self._rendered(source))

    def _rendered(self, source: Source) -> Iterator[str]:
        gutter = len(str(max(self.span.line, *(r.span.line for r in self.related), 1)))
        yield f"{_place(source, self.span)}: {self.rule}: {self.message}"
        yield from _excerpt(source, self.span, gutter)
        for related in self.related:
            yield f"{' ' * gutter} = {related.text}, at {_place(source, related.span)}"
            yield from _excerpt(source, related.span, gutter)
        if self.path:
            yield f"{' ' * gutter} = at: {self.path}"
        if self.hint:
            yield f"{' ' * gutter} = hint: {self.hint}"


def in_order(findings: Iterable[Finding]) -> list[Finding]:
    """Sort the findings from the top of the file down, each said once."""
    unique = dict.fromkeys(findings)
    return sorted(unique, key=lambda f: (f.span, f.rule, f.message))


def did_you_mean(word: str, known: Iterable[str], *, otherwise: str = "") -> str:
    """Hint at what a misspelt word was to be: its nearest neighbour, or else all the choices."""
    choices = list(known)
    near = get_close_matches(word, choices)
    if near:
        return f"did you mean `{near[0]}`?"
    if otherwise or not choices:
        return otherwise
    return "choose one of " + ", ".join(f"`{choice}`" for choice in choices)


# A word or a quotation of more characters than any name, type or formula has.
_TOO_LONG = re.compile(r"[^\s`]{121,}|(?<=`)[^`]{241,}(?=`)")


def _shortened(text: str) -> str:
    return _TOO_LONG.sub(lambda found: f"{found[0][:40]}...", text)


# Enough of a long line to show the place; the rest of a 10 000-column line helps nobody.
_WIDTH = 100


def _place(source: Source, span: Span) -> str:
    return f"{source.name}:{span.line}:{span.column}"


def _excerpt(source: Source, span: Span, gutter: int) -> Iterator[str]:
    line, column = source.line(span.line), span.column - 1
    start = 0 if column < _WIDTH * 3 // 4 else column - _WIDTH // 2
    shown = line[start : start + _WIDTH]
    # Tabs become one blank and invisible characters a mark, so that the caret stands right.
    clean = "".join(
        " " if c == "\t" else c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in shown
    )
    carets = "^" * max(1, min(span.length, len(clean) - (column - start)))
    yield f"{span.line:>{gutter}} | {clean.rstrip()}"
    yield f"{' ' * gutter} | {' ' * (column - start)}{carets}"
