"""Characters in Python source: which are shown as they are, and how many columns they take.

Linters refuse characters that look like others (a Cyrillic letter in an ASCII word), and no two
tools agree on the width of rare ones. The tables are our own, not those of the running Python:
the same spec must give the same text everywhere.
"""

from __future__ import annotations

import re

# Scripts and symbols that editors show and linters take; what is not here is written as an escape.
_SHOWN = "".join(
    f"{chr(low)}-{chr(high)}"
    for low, high in (
        (0x20, 0x7E),
        (0xA1, 0xAC),
        (0xAE, 0x17F),
        (0x386, 0x38A),
        (0x38E, 0x3A1),
        (0x3A3, 0x3FF),
        (0x400, 0x45F),
        (0x490, 0x4FF),
        (0x2010, 0x2027),
        (0x2030, 0x203A),
        (0x20A0, 0x20BF),
        (0x2100, 0x214F),
        (0x2150, 0x215E),
        (0x2190, 0x22FF),
        (0x2500, 0x25FC),
        (0x3001, 0x3002),
        (0x3008, 0x3011),
        (0x3041, 0x3096),
        (0x30A1, 0x30FF),
        (0x3400, 0x4DBF),
        (0x4E00, 0x9FFF),
        (0xAC00, 0xD7A3),
    )
)
# Of those, the letters that look like others: escaped where a word is made of such letters alone,
# or holds ASCII as well.
_LETTERS = (
    "\u0131\u017f\u0391\u0392\u0395\u0396\u0397\u0399\u039a\u039c\u039d\u039f\u03a1\u03a4\u03a5"
    "\u03a7\u03b1\u03b3\u03b9\u03bd\u03bf\u03c1\u03c3\u03c5\u03d2\u03dc\u03e8\u03f1\u03f2\u03f3"
    "\u03f9\u03fa\u0405\u0406\u0408\u0410\u0412\u0415\u0417\u041a\u041c\u041d\u041e\u0420\u0421"
    "\u0422\u0423\u0425\u042c\u0430\u0431\u0433\u0435\u043e\u0440\u0441\u0443\u0445\u0455\u0456"
    "\u0458\u04ae\u04af\u04bb\u04bd\u04c0\u04cf\u04e0\u2102\u210a-\u2113\u2115\u2119-\u211d\u2124"
    "\u2128\u212a\u212c\u212d\u212f-\u2131\u2133\u2134\u2139\u213d\u2145-\u2149\u30ce\u4e36\u4e3f"
)
# And those that are no letters: escaped wherever they stand.
_SIGNS = (
    "\u00b4\u00b8\u00d7\u2010-\u2013\u2018-\u201b\u2024\u2032\u2035\u2039\u203a\u212e"
    "\u2212\u2215-\u2217\u2223\u2228\u222a\u2236\u223c\u22a4\u22c1\u22c3\u22ff\u2571\u2573"
)
_ODD = re.compile(f"[^{_SHOWN}]|[{_SIGNS}]")
_LETTER = re.compile(f"[{_LETTERS}]")
_WORD = re.compile(r"\w+")
# A word with such a character, and without ASCII, is a word of its script.
_OWN = re.compile(f"[^\x00-\x7f{_LETTERS}]")
_WIDE = "\u3001-\u3011\u3041-\u30ff\u3400-\u4dbf\u4e00-\u9fff\uac00-\ud7a3"
_ANY_WIDE = re.compile(f"[{_WIDE}]")
# Lines may be broken before and behind a wide character, unless that would leave a word of those
# letters alone.
_ALIKE = "\u30ce\u4e36\u4e3f"
_UNBROKEN = re.compile(f"[{_WIDE}]?[{_ALIKE}]+[{_WIDE}]?|[{_WIDE}]|[^{_WIDE}]+")


def shown(text: str) -> str:
    """Escape what is not shown as it is; quotes and backslashes stay."""
    if text.isascii() and text.isprintable():
        return text
    return _WORD.sub(_of_its_script, _ODD.sub(_escaped, text))


def columns(text: str) -> int:
    """Return the number of columns of `text`, which `shown` has escaped."""
    return len(text) if text.isascii() else len(text) + len(_ANY_WIDE.findall(text))


def unbroken(text: str) -> list[str]:
    """Split `text` into parts that a line break must not divide, where there are no blanks."""
    return [text] if text.isascii() else _UNBROKEN.findall(text)


def escape(character: str) -> str:
    """Write a character as an escape that every kind of string knows."""
    code = ord(character)
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def _escaped(found: re.Match[str]) -> str:
    return escape(found[0])


def _of_its_script(word: re.Match[str]) -> str:
    own = _OWN.search(word[0]) is not None and not any(map(str.isascii, word[0]))
    return word[0] if own else _LETTER.sub(_escaped, word[0])
