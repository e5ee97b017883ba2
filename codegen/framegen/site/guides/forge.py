"""What forges add to Markdown: alerts, tasks, words struck through, footnotes, details."""

from __future__ import annotations

import re
from itertools import pairwise
from typing import TYPE_CHECKING

from markdown_it.token import Token
from markupsafe import Markup

from framegen.site.guides.details import use_details
from framegen.site.guides.footnotes import use_footnotes

if TYPE_CHECKING:
    from collections.abc import Sequence

    from markdown_it import MarkdownIt
    from markdown_it.rules_core import StateCore

_ALERT = re.compile(r"\[!(NOTE|TIP|IMPORTANT|WARNING|CAUTION)\][ \t]*(?:\n|\Z)", re.IGNORECASE)
_TASK = re.compile(r"\[([ xX])\] +(?=\S)")
_WARNINGS = ("WARNING", "CAUTION")
_TASKS = {"☑": "done", "☐": "to do"}


def use_forge(markdown: MarkdownIt) -> MarkdownIt:
    """Let a parser read what forges add. Their marks are as in GitHub's Markdown."""
    markdown.enable("strikethrough")
    markdown.core.ruler.after("block", "alerts", _alerts)
    markdown.core.ruler.push("tasks", _tasks)
    markdown.add_render_rule("task", _task)
    return use_details(use_footnotes(markdown))


def _alerts(state: StateCore) -> None:
    """Make a callout of each quotation that begins with a mark, such as `[!NOTE]`."""
    tokens = state.tokens
    # From the last to the first, so that the places of those before stay.
    for at in range(len(tokens) - 3, -1, -1):
        quote, paragraph, text = tokens[at : at + 3]
        found = _ALERT.match(text.content)
        opens = (quote.type, paragraph.type) == ("blockquote_open", "paragraph_open")
        alone = bool(found and found.end() == len(text.content))
        if not opens or quote.level or found is None or (alone and _is_last(tokens, at + 4)):
            continue
        _close(tokens, at)
        quote.tag = "div"
        kind = found[1].upper()
        quote.attrSet("class", "warning" if kind in _WARNINGS else "note")
        text.content = text.content[found.end() :]
        text.map = [(text.map or [0])[0] + 1, (text.map or [0, 0])[1]]
        if alone:
            del tokens[at + 1 : at + 4]
        tokens[at + 1 : at + 1] = _title(kind.capitalize())


def _is_last(tokens: Sequence[Token], at: int) -> bool:
    return tokens[at].type == "blockquote_close"


def _close(tokens: Sequence[Token], at: int) -> None:
    """Let the end of the quotation that begins there be that of a callout."""
    ends = (each for each in tokens[at:] if each.type == "blockquote_close" and not each.level)
    next(ends).tag = "div"


def _title(words: str) -> list[Token]:
    inside = Token("inline", "", 0, content=f"**{words}**", children=[])
    return [
        Token("alert_title_open", "p", 1, block=True),
        inside,
        Token("alert_title_close", "p", -1, block=True),
    ]


def _tasks(state: StateCore) -> None:
    """Make a box of the mark that an item of a list begins with: `[ ]` or `[x]`."""
    for at, (item, paragraph) in enumerate(pairwise(state.tokens)):
        if (item.type, paragraph.type) != ("list_item_open", "paragraph_open"):
            continue
        children = state.tokens[at + 2].children or []
        found = _TASK.match(children[0].content) if children[:1] else None
        if found is None or children[0].type != "text":
            continue
        item.attrSet("class", "task")
        children[0].content = children[0].content[found.end() :]
        box = "☐" if found[1] == " " else "☑"
        children[:0] = [Token("task", "", 0, content=box), Token("text", "", 0, content=" ")]


def _task(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    box = tokens[index].content
    return str(Markup('<span role="img" aria-label="{}">{}</span>').format(_TASKS[box], box))
