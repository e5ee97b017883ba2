"""Parts of a guide that a reader opens: `<details>` and `<summary>`, the only HTML that is read."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from markdown_it import MarkdownIt
    from markdown_it.rules_block import StateBlock

_OPEN = re.compile(r"<details( +open(?:=(?:\"\"|\"open\"|open))?)?>[ \t]*", re.IGNORECASE)
_CLOSE = re.compile(r"</details>[ \t]*\Z", re.IGNORECASE)
_SUMMARY = re.compile(r"\s*<summary>(.*?)</summary>[ \t]*\n", re.IGNORECASE | re.DOTALL)
_FENCE = re.compile(r"```|~~~")
# What browsers call a part that has no summary.
_UNNAMED = "Details"


def use_details(markdown: MarkdownIt) -> MarkdownIt:
    """Let a parser read parts to be opened: each tag on lines of its own, Markdown between them."""
    ends = ["paragraph", "reference", "blockquote", "list"]
    markdown.block.ruler.before("html_block", "details", _details, {"alt": ends})
    return markdown


def _details(state: StateBlock, start: int, end: int, silent: bool) -> bool:
    opened = None if state.is_code_block(start) else _OPEN.match(_line(state, start))
    last = _end(state, start, end) if opened else start
    if opened is None or last == start:
        return False
    text = state.getLines(start, last, state.blkIndent, keepLastLF=False)[opened.end() :] + "\n"
    summary = _SUMMARY.match(text)
    if summary is None and text.partition("\n")[0].strip():
        return False
    if silent:
        return True
    part = state.push("details_open", "details", 1)
    part.attrs = {"class": "more", **({"open": ""} if opened[1] else {})}
    part.map = [start, last + 1]
    before = "" if summary is None else text[: summary.start(1)]
    state.push("summary_open", "summary", 1)
    words = state.push("inline", "", 0)
    words.content = _UNNAMED if summary is None else summary[1].strip()
    words.map = [start + before.count("\n"), last]
    words.children = []
    state.push("summary_close", "summary", -1)
    body = start + (1 if summary is None else max(1, summary[0].count("\n")))
    around, state.lineMax = state.lineMax, last
    state.md.block.tokenize(state, min(body, last), last)
    state.lineMax = around
    state.push("details_close", "details", -1)
    state.line = last + 1
    return True


def _line(state: StateBlock, number: int) -> str:
    return state.src[state.bMarks[number] + state.tShift[number] : state.eMarks[number]]


def _end(state: StateBlock, start: int, end: int) -> int:
    """Return the line that closes the part which begins at `start`; `start` where none does."""
    depth, in_fence = 0, False
    for number in range(start, end):
        if not state.isEmpty(number) and state.sCount[number] < state.blkIndent:
            break
        line = _line(state, number)
        in_fence ^= _FENCE.match(line) is not None
        if in_fence:
            continue
        depth += (_OPEN.match(line) is not None) - (_CLOSE.match(line) is not None)
        if depth == 0:
            return number
    return start
