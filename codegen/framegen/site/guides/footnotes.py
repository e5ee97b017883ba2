"""Footnotes, as forges write them: `[^name]` in the text, and `[^name]: words` anywhere below."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from markdown_it.token import Token
from markupsafe import Markup

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from markdown_it import MarkdownIt
    from markdown_it.rules_block import StateBlock
    from markdown_it.rules_core import StateCore
    from markdown_it.rules_inline import StateInline

_NAME = re.compile(r"\[\^([^\s\[\]]+)\]")
_DEFINITION = re.compile(rf"{_NAME.pattern}:[ \t]*")
# What of the environment of a parser holds the names of all footnotes of a text.
_KNOWN = "footnotes"
# Lines that are indented so far go on with a footnote.
_INDENT = 4


def use_footnotes(markdown: MarkdownIt) -> MarkdownIt:
    """Let a parser read footnotes. Those of a text stand at its end, in the order of their use."""
    markdown.block.ruler.before(
        "reference", "footnote", _definition, {"alt": ["paragraph", "reference"]}
    )
    markdown.inline.ruler.before("link", "footnote_ref", _reference)
    markdown.core.ruler.after("inline", "footnotes", _collect)
    markdown.add_render_rule("footnote_ref", _shown_reference)
    markdown.add_render_rule("footnote_back", _shown_way_back)
    return markdown


def _definition(state: StateBlock, start: int, end: int, silent: bool) -> bool:
    """Read a footnote: the rest of its line, and what is indented below it."""
    line = state.src[: state.eMarks[start]]
    found = _DEFINITION.match(line, state.bMarks[start] + state.tShift[start])
    if found is None or state.is_code_block(start):
        return False
    known = state.env.setdefault(_KNOWN, set())
    if found[1] in known:
        return False
    if silent:
        return True
    known.add(found[1])
    before = state.bMarks[start], state.tShift[start], state.sCount[start]
    opened = state.push("footnote_open", "li", 1)
    opened.meta["name"] = found[1]
    state.blkIndent += _INDENT
    # Its words begin behind the colon, as if they were indented.
    state.bMarks[start], state.tShift[start] = found.end(), 0
    state.sCount[start] = state.blkIndent
    state.md.block.tokenize(state, start, end)
    state.blkIndent -= _INDENT
    state.bMarks[start], state.tShift[start], state.sCount[start] = before
    state.push("footnote_close", "li", -1)
    return True


def _reference(state: StateInline, silent: bool) -> bool:
    found = _NAME.match(state.src, state.pos, state.posMax)
    if found is None or found[1] not in state.env.get(_KNOWN, ()):
        return False
    if not silent:
        state.push("footnote_ref", "", 0).meta["name"] = found[1]
    state.pos = found.end()
    return True


def _collect(state: StateCore) -> None:
    """Put the footnotes at the end, each with its number."""
    text, notes = _taken_apart(state.tokens)
    if not notes:
        return
    uses: dict[str, int] = {}
    places: dict[str, int] = {}
    for token in (*text, *(each for note in notes.values() for each in note)):
        for child in token.children or ():
            if child.type == "footnote_ref":
                name = child.meta["name"]
                uses[name] = uses.get(name, 0) + 1
                child.meta |= {"place": places.setdefault(name, len(places) + 1), "use": uses[name]}
    # What nobody refers to is shown all the same, behind the others.
    for name in notes:
        places.setdefault(name, len(places) + 1)
    listed = [
        token
        for name, place in sorted(places.items(), key=lambda item: item[1])
        for token in _listed(notes[name], place, uses.get(name, 0))
    ]
    section = {"class": "footnotes", "aria-label": "Footnotes"}
    state.tokens = [
        *text,
        Token("footnotes_open", "section", 1, block=True, attrs={**section}),
        Token("footnote_list_open", "ol", 1, block=True),
        *listed,
        Token("footnote_list_close", "ol", -1, block=True),
        Token("footnotes_close", "section", -1, block=True),
    ]


def _taken_apart(tokens: Sequence[Token]) -> tuple[list[Token], dict[str, list[Token]]]:
    """Return the text without its footnotes, and each of them by its name."""
    text: list[Token] = []
    notes: dict[str, list[Token]] = {}
    # One may stand within another.
    into = [text]
    for token in tokens:
        if token.type == "footnote_open":
            into.append(notes.setdefault(token.meta["name"], []))
        into[-1].append(token)
        if token.type == "footnote_close":
            into.pop()
    return text, notes


def _listed(note: list[Token], place: int, uses: int) -> Iterator[Token]:
    """Yield a footnote with its anchor, and with the ways back behind its last words."""
    note[0].attrSet("id", f"fn:{place}")
    ways = [
        Token("footnote_back", "", 0, meta={"place": place, "use": use})
        for use in range(1, uses + 1)
    ]
    words = note[-3] if len(note) > 3 and note[-2].type == "paragraph_close" else None
    if words is not None and words.children is not None:
        words.children += ways
        ways = []
    yield from note[:-1]
    yield from ways
    yield note[-1]


def _anchor(token: Token) -> str:
    place, use = token.meta["place"], token.meta["use"]
    return f"fnref:{place}" if use == 1 else f"fnref:{place}:{use}"


def _shown_reference(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    link = Markup('<sup><a id="{0}" href="#fn:{1}" aria-label="Footnote {1}">{1}</a></sup>')
    return str(link.format(_anchor(tokens[index]), tokens[index].meta["place"]))


def _shown_way_back(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    link = Markup(' <a href="#{}" aria-label="Back to the text of footnote {}">↩</a>')
    return str(link.format(_anchor(tokens[index]), tokens[index].meta["place"]))
