"""Hex as people paste it: glued or spaced, with 0x, commas or colons, in one piece or in many."""

from __future__ import annotations

import re

_WORD = re.compile(r"[^\s,:;]+")
_PREFIX = re.compile(r"0[xX]")
_NO_DIGIT = re.compile(r"[^0-9A-Fa-f]")
# Enough to find the place by; a long paste is cut around it.
_SHOWN = 30


class NoHex(ValueError):  # noqa: N818 - says what the text is
    """Text that is no hex. `hint` says what to write; the message shows the place."""

    def __init__(self, message: str, hint: str) -> None:
        super().__init__(message)
        self.hint = hint


def read_hex(text: str) -> bytes:
    """Read bytes from hex of any usual shape. Raises NoHex."""
    data = b""
    for match in _WORD.finditer(text):
        word, at = match.group(), match.start()
        prefix = _PREFIX.match(word)
        digits = word if prefix is None else word[prefix.end() :]
        at += len(word) - len(digits)
        wrong = _NO_DIGIT.search(digits)
        if wrong is not None:
            raise NoHex(
                f"`{_visible(wrong.group())}` is no hex digit{_pointed(text, at + wrong.start())}",
                "write two digits a byte, like 55 55 02 07",
            )
        if not digits:
            raise NoHex(
                f"no digits come after `{word}`{_pointed(text, at)}",
                "write the byte whole, like 0x55",
            )
        if prefix is not None and len(digits) == 1:
            digits = f"0{digits}"
        if len(digits) % 2:
            place = _pointed(text, at, len(digits))
            if len(digits) == 1:
                raise NoHex(f"`{digits}` is half a byte{place}", f"did you mean 0{digits}?")
            raise NoHex(
                f"{len(digits)} digits make no whole number of bytes{place}",
                "look for a digit that was lost or added",
            )
        data += bytes.fromhex(digits)
    if not data:
        raise NoHex("there are no bytes to explain", "give them in hex, like 55 55 02 07")
    return data


def _pointed(text: str, at: int, length: int = 1) -> str:
    """Show the place in the text, with a caret under it."""
    start = max(0, at - _SHOWN)
    line = _visible(text[start : at + _SHOWN])
    return (
        f"\n  {line}\n  {' ' * (at - start)}{'^' * max(1, min(length, len(line) - (at - start)))}"
    )


def _visible(text: str) -> str:
    """Show blanks as blanks and what cannot be seen as a mark, one for one."""
    return "".join(
        " " if c.isspace() else c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text
    )
