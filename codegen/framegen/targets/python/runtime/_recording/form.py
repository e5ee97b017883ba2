"""Distinguish a text recording from raw bytes, by how it begins, and read its text in lines."""

from __future__ import annotations

import re

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

# A line of a recording: hex, and in a comment the time, the sender, and the message.
TIMED_LINE = re.compile(
    r"(?P<hex>[^#]*)#+ *(?P<at>[0-9]{1,9}(?:\.[0-9]{1,9})?) s, (?P<who>[^:]*): (?P<what>.*)"
)
# No line of a recording is longer; a longer one is passed on in pieces.
LONGEST_LINE = 65536

_MARK = b"\xef\xbb\xbf"  # what some editors write in front of text
_SKIPPED = re.compile(
    rb"(?:\xef\xbb\xbf)?(?:[ \t\n\r\v\f,:;_-]|#[^\x00-\x08\x0a-\x0c\x0e-\x1f\x7f]*\n)*"
)
_NO_COMMENT = re.compile(rb"#[^\n]*[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]")
_WORD = re.compile(rb"[^ \t\n\r\v\f,:;_#-]*")
_HEX_WORD = re.compile(rb"(?:[0-9A-Fa-f]|0[xX]|\\[xX])*(?P<begun>\\?)")
# So many letters that are all hex digits are meant as hex.
_ENOUGH = 16
_NOT_PRINTABLE = re.compile(rb"[^\n]*[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\xff]")
_LOOKED_AT = 4096


def is_text(begun: bytes, *, ended: bool) -> bool | None:
    """Return whether bytes that begin so are hex written as text; None while that is undecided.

    The answer follows from the first word alone, wherever the bytes are cut: it is made of hex
    digits; or it is a typing error in a line that has the form of a recording. `ended` says that no
    more bytes will come.
    """
    if len(begun) < len(_MARK) and _MARK.startswith(begun) and not ended:
        return None
    skipped = _SKIPPED.match(begun)
    rest = begun[skipped.end() :] if skipped else begun
    if rest and not rest.startswith(b"#"):
        return _is_hex_word(rest, ended=ended)
    if _NO_COMMENT.match(rest):
        return False
    return True if ended or len(begun) >= LONGEST_LINE else None


def _is_hex_word(rest: bytes, *, ended: bool) -> bool | None:
    found = _WORD.match(rest)
    word = found.group()[:_ENOUGH] if found else b""
    in_hex = _HEX_WORD.fullmatch(word)
    if in_hex and len(word) < _ENOUGH and len(word) == len(rest) and not ended:
        return None
    if in_hex and (len(word) == _ENOUGH or not in_hex["begun"]):
        return True
    return _is_timed_line(rest, ended=ended)


def _is_timed_line(rest: bytes, *, ended: bool) -> bool | None:
    line, end, _ = rest[:_LOOKED_AT].partition(b"\n")
    if _NOT_PRINTABLE.match(line):
        return False
    if end or ended or len(rest) >= _LOOKED_AT:
        return TIMED_LINE.match(line.decode("ascii")) is not None
    return None


def blocks(chunks: Iterable[bytes]) -> Iterator[str]:
    """Yield the text in whole lines, many at once; an overlong line comes in pieces."""
    held = bytearray()
    in_long = False
    is_begun = False
    for chunk in chunks:
        held += chunk
        if not is_begun:
            if len(held) < len(_MARK) and _MARK.startswith(held):
                continue
            is_begun = True
            if held.startswith(_MARK):
                del held[: len(_MARK)]
        # The end of a long line comes alone, so that what follows it is whole lines again.
        end = held.find(b"\n") + 1 if in_long else held.rfind(b"\n") + 1
        while end:
            yield held[:end].decode("utf-8", errors="replace")
            del held[:end]
            in_long = False
            end = held.rfind(b"\n") + 1
        while len(held) > LONGEST_LINE:
            yield held[:LONGEST_LINE].decode("utf-8", errors="replace")
            del held[:LONGEST_LINE]
            in_long = True
    if held:
        yield held.decode("utf-8", errors="replace")
