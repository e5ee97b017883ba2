"""Style sheets and scripts without what is for their authors: comments, indentation, blank lines.

Lines of a script stay lines, and names stay names, so that the code of a page can still be read
and stepped through. A script that has text over several lines is left as it is: blanks may have a
meaning there.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)


def compact_style(text: str) -> str:
    """Return a style sheet without comments and indentation, a rule a line."""
    lines = map(str.strip, _COMMENT.sub("", text).splitlines())
    whole = "".join(f"{line}\n" for line in lines if line)
    return re.sub(r"(?<=[{;,])\n(?!})|(?<=;)\n(?=})", "", whole)


def compact_script(text: str) -> str:
    """Return a script without indentation, and without the lines that are comments alone."""
    lines = text.splitlines()
    if any(line.count("`") % 2 or line.endswith("\\") for line in lines):
        return text
    return "".join(f"{line}\n" for line in _code(lines))


def _code(lines: list[str]) -> Iterator[str]:
    in_comment = False
    for line in map(str.strip, lines):
        rest = line
        if in_comment or line.startswith("/*"):
            _, end, after = line.partition("*/")
            in_comment = not end
            rest = after.strip()
        if rest and not rest.startswith("//"):
            yield rest
