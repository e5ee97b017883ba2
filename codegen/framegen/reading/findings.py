"""Findings about a spec: a rule, a place, what is wrong there and how to mend it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.reading.text import shown

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.reading.source import Source, Span


@dataclass(frozen=True, slots=True)
class Related:
    """A second place that a finding mentions, such as the first use of a duplicate."""

    span: Span
    text: str

    def __post_init__(self) -> None:
        object.__setattr__(self, "text", _shortened(self.text))


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing wrong with a spec.

    `rule` is the stable id; `path` the dotted path of the value (`messages.ServoMove.id`).
    Long quotations from the spec are cut short.
    """

    rule: str
    span: Span
    path: str
    message: str
    hint: str = ""
    related: tuple[Related, ...] = ()

    def __post_init__(self) -> None:
        for name in ("path", "message", "hint"):
            object.__setattr__(self, name, _shortened(getattr(self, name)))

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
    """Sort the findings from the top of the file down, without duplicates, up to a limit."""
    unique = sorted(dict.fromkeys(findings), key=lambda f: (f.span, f.rule, f.message))
    shown, more = unique[:MOST_FINDINGS], unique[MOST_FINDINGS:]
    if more:
        message = f"not shown: {pluralize(len(more), 'finding')} from here down"
        hint = "mend those above, and check again"
        shown.append(Finding("many-findings", more[0].span, more[0].path, message, hint))
    return shown


def did_you_mean(word: str, known: Iterable[str], *, otherwise: str = "") -> str:
    """Suggest what a misspelt word was meant to be: its nearest neighbour, or the choices."""
    choices = list(known)
    # Of two words, one three times as long as the other, too few letters can agree.
    longest = max(map(len, choices), default=0)
    near = get_close_matches(word, choices) if len(word) <= 3 * longest else []
    if near:
        return f"did you mean `{near[0]}`?"
    if otherwise or not choices:
        return otherwise
    named = ", ".join(f"`{choice}`" for choice in choices[:_MOST_CHOICES])
    others = len(choices) - _MOST_CHOICES
    return f"choose one of {named}" + (f" or {others} others" if others > 0 else "")


def slip_of(word: str, known: Iterable[str]) -> str:
    """Return the word that one or two slips made of this one; "" where it may be another word."""
    alike = [each for each in known if abs(len(each) - len(word)) <= _MOST_SLIPS]
    return next(iter(get_close_matches(word, alike, 1, _ALMOST_EQUAL)), "")


# What one or two slips make of a name.
_ALMOST_EQUAL, _MOST_SLIPS = 0.85, 2
# More than anybody mends in one go.
MOST_FINDINGS = 50
_MOST_CHOICES = 20
# A word or a quotation of more characters than any name, type or formula has; and all of a text.
_TOO_LONG = re.compile(r"[^\s`.]{121,}|(?<=`)[^`]{241,}(?=`)")
_MOST_CHARACTERS = 1000


def _shortened(text: str) -> str:
    if len(text) <= 120:
        return text
    text = _TOO_LONG.sub(lambda found: f"{found[0][:40]}...", text)
    return text if len(text) <= _MOST_CHARACTERS else f"{text[:_MOST_CHARACTERS]}..."


# Enough of a long line to show the place; the rest of a 10 000-column line helps nobody.
_WIDTH = 100


def _place(source: Source, span: Span) -> str:
    return f"{source.name}:{span.line}:{span.column}"


def _excerpt(source: Source, span: Span, gutter: int) -> Iterator[str]:
    line, column = source.line(span.line), span.column - 1
    start = 0 if column < _WIDTH * 3 // 4 else column - _WIDTH // 2
    clean = shown(line[start : start + _WIDTH])
    carets = "^" * max(1, min(span.length, len(clean) - (column - start)))
    yield f"{span.line:>{gutter}} | {clean.rstrip()}"
    yield f"{' ' * gutter} | {' ' * (column - start)}{carets}"
