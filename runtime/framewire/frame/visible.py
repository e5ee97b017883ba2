"""Text that others chose, such as names of files, made harmless and plain to see on a screen."""

from __future__ import annotations

import re

# Controls, overrides of direction, characters of no width, and halves of a pair of surrogates,
# as which Python reads the bytes of a name that are no text. No tab and no line feed.
_HIDDEN = (
    r"\x00-\x08\x0b-\x1f\x7f-\x9f\xad\u061c\u180e\u200b-\u200f\u2028-\u202e\u2060-\u206f"
    r"\ud800-\udfff\ufe00-\ufe0f\ufeff\ufff9-\ufffb\U000e0000-\U000e0fff"
)
_IN_TEXT = re.compile(f"[{_HIDDEN}]")
_IN_LINE = re.compile(rf"[\t\n{_HIDDEN}]")


def visible(text: str) -> str:
    r"""Escape what could control a terminal, on one line: an escape character as `\x1b`."""
    return _IN_LINE.sub(_escape, text)


def visible_lines(text: str) -> str:
    """Escape the same in text of several lines: tabs and line feeds stay."""
    return _IN_TEXT.sub(_escape, text)


def _escape(found: re.Match[str]) -> str:
    return found[0].encode("unicode_escape").decode("ascii")
