"""Hex as people paste it: `0A 1B 02 FF`, `0x0A, 0x1B`, `0A1B02FF`, over any lines.

Bytes may be separated by blanks, commas, colons, semicolons, dashes and underscores, and a comment
goes from a `#` to the end of the line. A byte is two digits, with or without `0x` before it (its
x may be a multiplication sign, as in printed manuals), or the
backslash and x of strings in C and Python; after one of these prefixes, a single digit at the end
of a word is a byte, too; and so is a word of 0b and eight binary digits. Nothing else is hex.

The script of the decoder's page reads the same.
"""

from __future__ import annotations

import re

_BETWEEN = " \t\n\r\v\f\N{NO-BREAK SPACE}\N{ZERO WIDTH NO-BREAK SPACE},:;_-"
_COMMENT = re.compile(r"#[^\n]*")
_WORD = re.compile(f"[^{_BETWEEN}]+")
_BEFORE_COMMENT = re.compile(f"[^#{_BETWEEN}]+")
_AS_BLANKS = str.maketrans(dict.fromkeys(_BETWEEN, " "))
_PREFIX = r"(?:0[xX\u00d7]|\\[xX])"
_BYTES = re.compile(rf"(?:{_PREFIX}?[0-9A-Fa-f]{{2}})*")
_LAST = re.compile(rf"{_PREFIX}[0-9A-Fa-f]")
# What may stand at the end of a piece, when the rest of the byte comes in the next one.
_BEGUN = re.compile(rf"(?:0|\\|{_PREFIX}[0-9A-Fa-f]?|[0-9A-Fa-f])?")
_DIGITS = re.compile(rf"(?:^|{_PREFIX})([0-9A-Fa-f]+)$")
_NO_DIGIT = re.compile(r"[^0-9A-Fa-f]")
_BINARY = re.compile(rf"(?<![^{_BETWEEN}])0b([01]{{8}})(?![^{_BETWEEN}])")
_BINARY_BEGUN = re.compile(r"0b[01]{0,8}")


class HexError(ValueError):
    """Text that is no hex: the wrong part, its word and position, and what to do."""

    def __init__(self, word: str, wrong: str, at: int, problem: str, hint: str) -> None:
        where = "" if wrong == word else f" in {_shortened(word)!r}"
        super().__init__(f"no hex: {_shortened(wrong)!r}{where} {problem}; {hint}")
        self.wrong = wrong
        self.at = at
        self.problem = problem
        self.hint = hint


def read_hex(text: str) -> bytes:
    """Read hex text as bytes. Raises HexError."""
    try:
        # As most hex is written, and many times as fast.
        return bytes.fromhex(_without_binary(text))
    except ValueError:
        plain = _COMMENT.sub(lambda comment: " " * len(comment.group()), text)
    try:
        return bytes.fromhex(_without_binary(plain).translate(_AS_BLANKS))
    except ValueError:
        return b"".join(_whole_word(word.group(), word.start()) for word in _WORD.finditer(plain))


def _without_binary(text: str) -> str:
    """Write words of binary digits in hex."""
    if "0b" not in text:
        return text
    return _BINARY.sub(lambda word: f"{int(word[1], 2):02x}", text)


def is_hex(text: str) -> bool:
    """Tell whether text is hex of at least one byte."""
    try:
        return bool(read_hex(text))
    except HexError:
        return False


class HexReader:
    """A reader of hex that arrives in pieces, cut anywhere."""

    def __init__(self) -> None:
        self._begun = ""
        self._in_comment = False
        # Whether bytes of the word that goes on in the next piece are read already.
        self._in_word = False

    def feed(self, text: str) -> bytes:
        """Read a further piece, except for a byte that has only begun. Raises HexError."""
        if self._in_comment:
            _, end, text = text.partition("\n")
            self._in_comment = not end
        text = self._begun + text
        # The rest of a word that has begun in another piece, and what there is of one that goes on
        # in the next, are no words.
        goes_on = _BEFORE_COMMENT.match(text) if self._in_word else None
        first = goes_on.group() if goes_on else ""
        last = ""
        comment = text.find("#", text.rfind("\n") + 1)
        if comment >= 0:
            self._in_comment = True
            text = text[:comment]
            self._begun = ""
            self._in_word = False
        else:
            last = text[max(map(text.rfind, _BETWEEN)) + 1 :]
            is_later = self._in_word and last == text
            if _BINARY_BEGUN.fullmatch(last) and not is_later:
                self._begun = last
            else:
                self._begun = _rest(last)
                if not _BEGUN.fullmatch(self._begun):
                    self._begun = ""
            self._in_word = is_later or len(last) > len(self._begun)
            text = text[: len(text) - len(self._begun)]
            last = last[: len(last) - len(self._begun)]
            if is_later:
                return _read_word(text, 0)
        whole = text[len(first) : len(text) - len(last)]
        return _read_word(first, 0) + read_hex(whole) + _read_word(last, len(text) - len(last))

    def end(self) -> bytes:
        """Read the byte that has begun, now that nothing follows. Raises HexError."""
        begun, self._begun = self._begun, ""
        return read_hex(begun)


def _rest(word: str) -> str:
    """Return what follows the whole bytes of a word."""
    if _NO_DIGIT.search(word) is None:
        return word[len(word) // 2 * 2 :]
    whole = _BYTES.match(word)
    return word[whole.end() :] if whole else word


def _whole_word(word: str, at: int) -> bytes:
    binary = _BINARY.fullmatch(word)
    return bytes([int(binary[1], 2)]) if binary else _read_word(word, at)


def _read_word(word: str, at: int) -> bytes:
    rest = _rest(word)
    digits = re.sub(_PREFIX, "", word[: len(word) - len(rest)])
    if _LAST.fullmatch(rest):
        return bytes.fromhex(f"{digits}0{rest[-1]}")
    if rest:
        raise _refusal(word, len(word) - len(rest), at)
    return bytes.fromhex(digits)


def _refusal(word: str, rest_at: int, at: int) -> HexError:
    """Say what is wrong with a word, whose bytes up to `rest_at` are right."""
    prefix = re.compile(_PREFIX).match(word, rest_at)
    start = prefix.end() if prefix else rest_at
    if prefix and start == len(word):
        hint = f"write the byte whole, like {prefix.group()}1B"
        return HexError(word, prefix.group(), at + rest_at, "has no digits after it", hint)
    wrong = _NO_DIGIT.search(word, start)
    if wrong is not None:
        hint = "write two digits a byte, like 0A 1B FF"
        return HexError(word, wrong.group(), at + wrong.start(), "is no hex digit", hint)
    run = _DIGITS.search(word)
    digits, start = (run[1], run.start(1)) if run else (word, 0)
    if len(digits) == 1:
        return HexError(word, digits, at + start, "is half a byte", f"did you mean 0{digits}?")
    problem = f"is {len(digits)} digits, which is no whole number of bytes"
    hint = "look for a digit that was lost or added"
    return HexError(word, digits, at + start, problem, hint)


def _shortened(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:37]}..."
