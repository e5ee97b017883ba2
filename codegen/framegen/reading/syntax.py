"""Findings on text that is no YAML: what is wrong, and what to do about it.

The parser's own words (`did not find expected key`) say what it was doing, not what the author
did. So the text around the place is examined; the parser's words are used where that shows nothing.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.reading.findings import Finding, Related
from framegen.reading.source import Source, Span

if TYPE_CHECKING:
    import yaml

_ENTRY = re.compile(r"(?P<key>\s*(?:- +)*[^\s:#'\"\[{][^:#]*: +)(?P<value>\S.*?)\s*")
_CLOSING = {"[": "]", "{": "}"}
# What begins something of YAML's own, or nothing at all.
_RESERVED = "@`%*&!"


def syntax_finding(error: yaml.MarkedYAMLError, source: Source) -> Finding:
    """Return where the text stops being YAML, and how to mend it."""
    words = tuple(part for part in (error.context, error.problem) if part)
    at, begun = (_span(source, mark) for mark in (error.problem_mark, error.context_mark))
    slip = _Slip(source, at, begun, ", ".join(words))
    for look in _LOOKS:
        found = look(slip)
        if found is not None:
            return found
    return _finding(slip.at, f"this is not YAML: {slip.words}", "")


@dataclass(frozen=True, slots=True)
class _Slip:
    """Where the parser stopped, where the construct that it was reading began, and its words."""

    source: Source
    at: Span
    begun: Span
    words: str

    @property
    def line(self) -> str:
        return self.source.line(self.at.line)

    @property
    def opening(self) -> str:
        return self.character(self.begun)

    def character(self, span: Span) -> str:
        return self.source.line(span.line)[span.column - 1 : span.column]

    def indent(self, number: int) -> int | None:
        """Return the indentation of a line; None for one that is empty, or a comment."""
        line = self.source.line(number)
        rest = line.lstrip(" ")
        return None if not rest or rest.startswith("#") else len(line) - len(rest)

    def indents_above(self) -> list[int]:
        """Return the indentations that the line could belong to, the nearest first."""
        found: list[int] = []
        for number in range(self.at.line - 1, 0, -1):
            indent = self.indent(number)
            if indent is not None and (not found or indent < found[-1]):
                found.append(indent)
        return found


def _span(source: Source, mark: Any) -> Span:
    """Find the place of a parser's mark; behind the last line, it is at the end of that."""
    if mark is None:
        return Span(1, 1)
    if mark.line >= len(source.lines):
        return Span(len(source.lines), len(source.lines[-1]) + 1)
    return Span(mark.line + 1, mark.column + 1)


def _finding(span: Span, message: str, hint: str, *related: Related) -> Finding:
    return Finding("yaml-syntax", span, "", message, hint, related)


def _tab(slip: _Slip) -> Finding | None:
    blanks = len(slip.line) - len(slip.line.lstrip())
    place = slip.line.find("\t", 0, max(blanks, slip.at.column))
    if place < 0:
        return None
    what = "a tab stands here, and YAML is indented with blanks"
    return _finding(Span(slip.at.line, place + 1), what, "write blanks in its place")


def _quoted(slip: _Slip) -> Finding | None:
    if "escape" in slip.words:
        what = "a backslash in double quotes begins an escape, and this is none"
        return _finding(slip.at, what, "write two of them, or put the text in single quotes")
    if "quoted scalar" in slip.words:
        what = "the quote that opens here is not closed"
        return _finding(slip.begun, what, "close it at the end of the text")
    before = slip.line[: slip.at.column - 1].rstrip()
    if "block mapping" in slip.words and before.endswith(("'", '"')):
        inside = {"'": "''", '"': '\\"'}[before[-1]]
        what = "text stands behind the closing quote"
        hint = f"write a quote within the text as {inside}, or close the text above that is open"
        return _finding(slip.at, what, hint)
    return None


def _colon(slip: _Slip) -> Finding | None:
    if "mapping values are not allowed" not in slip.words:
        return None
    entry = _ENTRY.fullmatch(slip.line)
    if entry is None or entry.start("value") >= slip.at.column:
        return _swallowed(slip)
    value = entry["value"]
    what = "a text with a colon and a blank in it needs quotes"
    if set(value) & set('"\\'):
        return _finding(slip.at, what, "put all of it in quotes")
    return _finding(slip.at, what, f'write `{entry["key"].strip()} "{value}"`')


def _swallowed(slip: _Slip) -> Finding | None:
    """Find a line that continues the value above it, because it is indented further."""
    here = slip.indent(slip.at.line)
    above = slip.indents_above()
    if here is None or not above or here <= above[0]:
        return None
    return _finding(
        Span(slip.at.line, here + 1),
        f"this line is indented by {here}, and the one above it by {above[0]} has a value already",
        f"indent it by {above[0]}",
    )


def _bracket(slip: _Slip) -> Finding | None:
    found, closing = slip.character(slip.at), _CLOSING.get(slip.opening)
    if "flow" in slip.words and closing:
        what = f"a comma or `{closing}` is expected here"
        hint = "put commas between entries, and quotes around a text that has a colon or a quote"
        return _finding(slip.at, what, hint, Related(slip.begun, f"`{slip.opening}` opens here"))
    if found in _CLOSING.values():
        return _finding(
            slip.at, f"`{found}` closes nothing", "remove it, or put the text in quotes"
        )
    return None


def _reserved(slip: _Slip) -> Finding | None:
    for span in (slip.at, slip.begun):
        character = slip.character(span)
        if character and character in _RESERVED and "scanning" in slip.words:
            what = f"a text without quotes cannot begin with `{character}`"
            return _finding(span, what, "put it in quotes")
    return None


def _no_colon(slip: _Slip) -> Finding | None:
    if "could not find expected ':'" not in slip.words:
        return None
    line = slip.source.line(slip.begun.line).strip()
    key, _, value = line.partition(" ")
    hint = f"write `{key}: {value.strip() or '...'}`"
    return _finding(slip.begun, f"`{line}` is no key with a value", hint)


def _next_line(slip: _Slip) -> Finding | None:
    """Find text behind a key that has to begin below it."""
    if slip.opening in ("|", ">") and "block scalar" in slip.words:
        return _finding(
            slip.at, f"the text behind `{slip.opening}` begins on the next line", "move it there"
        )
    if slip.character(slip.at) == "-" and "sequence entries are not allowed" in slip.words:
        hint = "begin it on a line of its own, or write it in brackets: [a, b]"
        return _finding(slip.at, "a list does not begin behind its key", hint)
    return None


def _indented(slip: _Slip) -> Finding | None:
    """Find a line whose indentation matches none that it could belong to."""
    here, above = slip.indent(slip.at.line), slip.indents_above()
    if here is None or here != slip.at.column - 1 or not above:
        return None
    if here not in above:
        near = [each for each in above if each < here][:1]
        near += [each for each in above if each > here][-1:]
        what = f"this line is indented by {here}, as nothing is that it could belong to"
        return _finding(slip.at, what, f"indent it by {' or '.join(map(str, near))}")
    if slip.character(slip.at) == "-":
        what = "an element of a list stands among keys"
        return _finding(slip.at, what, "indent it further than the key that it belongs to")
    if slip.opening == "-":
        what = "a key stands among the elements of a list"
        hint = f"indent it by {here + 2}, if it belongs to the element above"
        return _finding(slip.at, what, hint, Related(slip.begun, "the list begins here"))
    return None


_LOOKS = (_tab, _quoted, _colon, _bracket, _reserved, _no_colon, _next_line, _indented)
