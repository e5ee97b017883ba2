"""Docstrings with text of a spec, which can neither end them nor run anything, and lints clean."""

from __future__ import annotations

import re

from framegen.targets.python.characters import columns, shown, unbroken
from framegen.targets.python.escape import WIDTH

# Three of these would end the docstring.
_QUOTES = re.compile(r'(?<="")"')
# Signs that are read the same in ASCII, and that linters want to be so: dashes, quotes, a minus.
TYPOGRAPHY = str.maketrans(
    {
        **dict.fromkeys("\u2010\u2011\u2012\u2013\u2212", "-"),
        **dict.fromkeys("\u2018\u2019\u201a\u201b\u2032\u00b4", "'"),
        "\u00d7": "x",
        "\u2236": ":",
        "\u223c": "~",
        # The wide forms that punctuation has between wide letters.
        **{chr(code): chr(code - 0xFEE0) for code in range(0xFF01, 0xFF5F)},
    }
)
_SENTENCE_END = re.compile(r"(?<=[^.]\.) (?=[A-Z])")
# A summary begins with a word or a number, and ends with what a full stop can follow.
_BEGINNING = re.compile(r"[A-Za-z0-9(`]|[^\x00-\x7f]")
_END = re.compile(r"[A-Za-z0-9)\]%\"']|[^\x00-\x7f\u2026\u3001\u3002]")
_LOWER = re.compile(r"[a-z](?![A-Za-z]*[A-Z0-9_`])")
_THIS = re.compile(r"\W*this\b", re.IGNORECASE)
# On a line by itself, each of these would be the heading of a section.
_HEADING = re.compile(
    r"(?:args|arguments|attention|attributes|caution|danger|error|examples?|extended summary|hint"
    r"|important|keyword arg(?:ument)?s|methods|notes?|other (?:arg(?:ument)?s|param(?:eter)?s)"
    r"|parameters|raises|receives|references|returns?|see also|short summary|tip|todo|warnings?"
    r"|warns|yields?)\W*",
    re.IGNORECASE,
)


def prose(text: str) -> str:
    """Escape `text` for the inside of a docstring: no quote can end it, no example in it be run."""
    folded = " ".join(text.translate(TYPOGRAPHY).split())
    # doctest runs what follows three of these, so prose must not be able to say them.
    safe = shown(folded.replace("\\", "\\u005c").replace(">>>", "> > >"))
    return _QUOTES.sub(r"\\u0022", safe)


def docstring(
    blocks: list[str],
    indent: int,
    otherwise: str,
    example: list[str] | None = None,
    *,
    function: str = "",
) -> str:
    """Return a docstring with quotes: a summary of one line, then a paragraph for each block.

    The summary is the first paragraph, or its first sentences. Where it is too long, is a question,
    or begins with a quote, `otherwise` is the summary, and the paragraphs follow it. `example` goes
    to the end as it is: lines of Python that the generator wrote itself. `function` is the name of
    what is documented, where that is a function.
    """
    paragraphs = [prose(part) for block in blocks for part in block.split("\n\n") if part.strip()]
    room = WIDTH - indent - 6
    found = _summary(paragraphs[0], room, function) if paragraphs else None
    summary, rest = (otherwise, "") if found is None else found
    paragraphs[: found is not None] = [rest] if rest else []
    margin = " " * indent
    if not paragraphs and not example:
        return f'"""{summary}"""'
    body = [summary]
    for paragraph in paragraphs:
        body += ["", *_wrapped(paragraph, WIDTH - indent - 3)]
    # Linters want no backslash in a docstring, unless it stands for a sign.
    given = [_QUOTES.sub(r"\\u0022", line.replace("\\", "\\u005c")) for line in example or ()]
    body += ["", *given] if given else []
    text = "\n".join(f"{margin}{line}" if line else "" for line in body)
    return f'"""{text[indent:]}\n{margin}"""'


def _summary(paragraph: str, room: int, function: str) -> tuple[str, str] | None:
    """Split `paragraph` into as many whole sentences as fit into `room`, and the rest; or None."""
    sentences = _SENTENCE_END.split(paragraph)
    for number in range(len(sentences), 0, -1):
        summary = " ".join(sentences[:number])
        if not summary.endswith("."):
            summary += "."
        if columns(summary) <= room:
            good = _is_summary(summary, function)
            return (_capital(summary), " ".join(sentences[number:])) if good else None
    return None


def _is_summary(text: str, function: str) -> bool:
    return (
        _BEGINNING.match(text) is not None
        and _END.fullmatch(text[:-1][-1:]) is not None
        and _THIS.match(text) is None
        and not (function and f"{function}(" in text)
    )


def _capital(text: str) -> str:
    return text[0].upper() + text[1:] if _LOWER.match(text) else text


def _wrapped(text: str, width: int) -> list[str]:
    """Break prose into lines; a longer word without blanks has a line of its own."""
    lines = [""]
    for word in text.split(" "):
        blank = " "
        for part in unbroken(word):
            longer = f"{lines[-1]}{blank if lines[-1] else ''}{part}"
            blank = ""
            if lines[-1] and columns(longer) > width:
                lines.append(part)
            else:
                lines[-1] = longer
    return [f"{line.rstrip(':')}." if _HEADING.fullmatch(line) else line for line in lines]
