"""Code blocks: coloured while the site is built, by classes, and with a button to copy."""

from __future__ import annotations

import re
from functools import cache
from itertools import groupby
from typing import TYPE_CHECKING

from markupsafe import Markup, escape
from pygments.lexers import get_lexer_by_name
from pygments.token import Comment, Generic, Keyword, Literal, Name, Number, Operator, String
from pygments.util import ClassNotFound

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from pygments.lexer import Lexer
    from pygments.token import _TokenType

# What the languages of the guides are called by readers.
_TITLES = {
    "bat": "the commands",
    "c": "C",
    "console": "the commands",
    "diff": "the difference",
    "json": "JSON",
    "powershell": "the commands",
    "pycon": "Python",
    "python": "Python",
    "sh": "the commands",
    "toml": "TOML",
    "yaml": "YAML",
}
# The classes of the style sheet: the first that holds a token is its own.
_CLASSES = (
    (Comment, "comment"),
    (Keyword.Constant, "number"),
    (Keyword, "keyword"),
    (Operator.Word, "keyword"),
    (Number, "number"),
    (String.Interpol, "name"),
    (String, "text"),
    (Literal.Scalar, ""),
    (Name.Tag, "name"),
    (Name.Function, "name"),
    (Name.Class, "name"),
    (Name.Decorator, "name"),
    (Name.Builtin.Pseudo, "number"),
    (Generic.Deleted, "deleted"),
    (Generic.Inserted, "inserted"),
    (Generic.Heading, "comment"),
    (Generic.Subheading, "comment"),
)
_SHELL = re.compile(r"(\$ )(.*)")
_PYTHON = re.compile(r"(>>> ?|\.\.\. ?)(.*)")
_Piece = tuple[str, str]


def code_block(code: str, language: str = "") -> Markup:
    """Return a block of code of a language, or of none, as HTML.

    What it copies is what a reader would type: of a session, the input alone. Output cannot be
    copied, and is shown as belonging to the block above it.
    """
    if language == "output":
        return Markup('<pre class="output" tabindex="0"><code>{}</code></pre>\n').format(code)
    pieces, typed = _read(code, language)
    label = " ".join(["Copy", _TITLES.get(language, "")]).strip()
    return Markup(
        '<div class="code"><pre class="{}" tabindex="0"><code>{}</code></pre>'
        '<button class="copy" type="button" data-script hidden aria-label="{}" data-copy="{}">'
        "Copy</button></div>\n"
    ).format(language or "text", _html(pieces), label, typed)


def _read(code: str, language: str) -> tuple[Iterable[_Piece], str]:
    """Return the pieces of a block, each a class and its text, and what of it is typed."""
    match language:
        case "console":
            return _session(code, _SHELL, "sh")
        case "pycon":
            return _session(code, _PYTHON, "python")
        case _:
            return _coloured(code, language), code


def _session(code: str, prompt: re.Pattern[str], language: str) -> tuple[list[_Piece], str]:
    """Read a session: lines with a prompt, in a language, and what was printed."""
    pieces: list[_Piece] = []
    typed = ""
    lines = [(prompt.fullmatch(line), line) for line in code.splitlines()]
    for is_input, each in groupby(lines, key=lambda line: line[0] is not None):
        if not is_input:
            pieces.append(("printed", "".join(f"{line}\n" for _, line in each)))
            continue
        found = [match for match, _ in each if match is not None]
        text = "".join(f"{match[2]}\n" for match in found)
        typed += text
        prompts = iter([match[1] for match in found])
        # Statements go over several lines, so all are read at once, and prompts put in again.
        for begins, (name, part) in _by_line(_coloured(text, language)):
            pieces += [("prompt", next(prompts))] if begins else []
            pieces.append((name or "typed", part))
    return pieces, typed


def _by_line(pieces: Iterable[_Piece]) -> Iterator[tuple[bool, _Piece]]:
    """Cut pieces at the ends of lines, and tell which of them begin one."""
    begins = True
    for name, text in pieces:
        for part in text.splitlines(keepends=True):
            yield begins, (name, part)
            begins = part.endswith("\n")


def _coloured(code: str, language: str) -> list[_Piece]:
    lexer = _lexer(language)
    if lexer is None:
        return [("", code)]
    return [(_class(kind), text) for kind, text in lexer.get_tokens(code)]


@cache
def _lexer(language: str) -> Lexer | None:
    try:
        return get_lexer_by_name(language, stripnl=False, ensurenl=False)
    except ClassNotFound:
        return None


@cache
def _class(kind: _TokenType) -> str:
    return next((name for group, name in _CLASSES if kind in group), "")


def _html(pieces: Iterable[_Piece]) -> Markup:
    found = Markup()
    for name, each in groupby(pieces, key=lambda piece: piece[0]):
        text = "".join(text for _, text in each)
        found += Markup('<span class="{}">{}</span>').format(name, text) if name else escape(text)
    return found
