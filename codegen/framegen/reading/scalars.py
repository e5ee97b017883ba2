"""The values of plain YAML scalars: only what YAML 1.1 and 1.2 agree on.

PyYAML reads YAML 1.1, editors read 1.2, and they differ on words (`no`), octals (`010`),
sexagesimals (`1:30`) and more. A spec means the same to everybody, so whatever the two read
differently is refused; the author writes what was meant, in quotes or in decimal.
"""

from __future__ import annotations

import re
from functools import lru_cache

# Both want digits on both sides of the point, and YAML 1.1 a sign in the exponent.
_FLOAT = re.compile(r"[-+]?(?:0|[1-9][0-9]*)\.[0-9]+(?:[eE][-+][0-9]+)?")
_INTEGER = re.compile(r"[-+]?(?:0|[1-9][0-9]*)|0x[0-9a-fA-F]+")
_NULLS = frozenset(["", "~", "null"])
_BOOLEANS = {"true": True, "false": False}

_AMBIGUOUS = (
    (
        re.compile(r"(?i:y|n|yes|no|on|off|true|false)"),
        "a truth value to YAML 1.1",
        'put it in quotes: "{text}"',
    ),
    (
        re.compile(r"(?i:null)"),
        "nothing at all to YAML",
        'write null, or put it in quotes: "{text}"',
    ),
    (
        re.compile(r"[-+]?0[0-9_]+"),
        "octal to YAML 1.1 and decimal to YAML 1.2",
        'write "{text}" for text or bytes, and {decimal} for a number',
    ),
    (
        re.compile(r"[-+]?[0-9][0-9_]*(?::[0-9]+)+(?:\.[0-9_]*)?"),
        "a number of base 60 to YAML 1.1",
        'put it in quotes: "{text}"',
    ),
    (
        re.compile(r"[-+]?(?:0b[01_]+|0o[0-7_]+|0x[0-9a-fA-F_]+|[0-9][0-9_]*)"),
        "a number to one YAML and text to another",
        "write it in decimal, or as 0x in hexadecimal without underscores",
    ),
    (
        re.compile(
            r"[-+]?(?:[0-9][0-9_]*\.[0-9_]*|\.[0-9][0-9_]*|[0-9]+(?=[eE]))(?:[eE][-+]?[0-9]+)?|[-+]?\.(?i:inf|nan)"
        ),
        "a floating-point number",
        'put it in quotes: "{text}"',
    ),
    (
        re.compile(r"[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}(?:[Tt ].*)?"),
        "a date to YAML 1.1",
        'put it in quotes: "{text}"',
    ),
    (re.compile(r"=|<<"), "an instruction to YAML 1.1", 'put it in quotes: "{text}"'),
)


# How each of them begins, or all of it. Most words are nothing of the kind.
_SUSPECT = re.compile(r"[-+.=<0-9]|(?i:y|n|yes|no|on|off|true|false|null)\Z")


class Ambiguous(ValueError):  # noqa: N818 - says what the scalar is
    """A plain scalar that YAML readers disagree on; `hint` says what to write instead."""

    def __init__(self, text: str, reads_as: str, hint: str) -> None:
        super().__init__(f"`{text}` without quotes is {reads_as}")
        self.hint = hint


@lru_cache(maxsize=512)
def resolve(text: str) -> str | int | float | bool | None:
    """Find the value of a plain scalar. Raises Ambiguous where YAML readers disagree.

    What is read often is kept: most keys of a spec stand in it many times.
    """
    if text in _NULLS:
        return None
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    if not _SUSPECT.match(text):
        return text
    # A number of a thousand digits is text to us: Python refuses to convert it.
    if _INTEGER.fullmatch(text) and len(text) < 40:
        return int(text, 0)
    if _FLOAT.fullmatch(text) and len(text) < 40:
        return float(text)
    for pattern, reads_as, hint in _AMBIGUOUS:
        if pattern.fullmatch(text):
            raise Ambiguous(text, reads_as, hint.format(text=text, decimal=_decimal(text)))
    return text


def _decimal(text: str) -> str:
    """Return `-0_10` as `-10`: the digits, where nobody can take them for octal."""
    sign = "-" if text.startswith("-") else ""
    return sign + (text.lstrip("+-").replace("_", "").lstrip("0") or "0")
