"""Distinguish a text recording from raw bytes, by how it begins, and read its text in lines.

Whatever reads a capture asks here. The Python target copies this file into each library, so it
imports the standard library alone.
"""

from __future__ import annotations

import re
from codecs import getincrementaldecoder
from itertools import chain

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

FORMS = ("auto", "hex", "raw")
"""What a file may hold: hex, as every recording does, or raw bytes; auto goes by its first word."""

# A line of a recording: hex, and in a comment the time, the sender, and the message.
TIMED_LINE = re.compile(
    r"(?P<hex>[^#]*)#+ *(?P<at>[0-9]{1,9}(?:\.[0-9]{1,9})?) s, (?P<who>[^:]*): (?P<what>.*)"
)
# No line of a recording is longer; a longer one is passed on in pieces.
LONGEST_LINE = 65536

_MARK = b"\xef\xbb\xbf"  # what some editors write in front of text
_WIDE_MARKS = (b"\xff\xfe", b"\xfe\xff")  # and others, as PowerShell, where it is in UTF-16
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


def begun_as(read_some: Callable[[], bytes], form: str) -> tuple[bytes, bool]:
    """Return how a capture of one of FORMS begins, and whether it is text.

    `read_some` returns what comes next, and nothing at the end.
    """
    begun = b""
    text = {"hex": True, "raw": False}.get(form)
    while text is None:
        more = read_some()
        begun += more
        text = is_text(begun, ended=not more)
    return begun, text


def is_text(begun: bytes, *, ended: bool) -> bool | None:
    """Return whether bytes that begin so are hex written as text; None while that is undecided.

    The answer follows from the first word alone, wherever the bytes are cut: it is made of hex
    digits; or it is a typing error in a line that has the form of a recording. Without a word, a
    comment and blanks are text; marks that separate nothing are bytes, of which none is lost.
    `ended` says that no more bytes will come.
    """
    ended = ended or len(begun) >= LONGEST_LINE
    begun = begun[:LONGEST_LINE]
    if not ended and any(mark.startswith(begun) for mark in (_MARK, *_WIDE_MARKS)):
        return None
    # Half of a character may follow.
    text = b"".join(_as_utf_8([begun[: len(begun) // 2 * 2]])) if _is_wide(begun) else begun
    skipped = _SKIPPED.match(text)
    rest = text[skipped.end() :] if skipped else text
    if rest and not rest.startswith(b"#"):
        return _is_hex_word(rest, ended=ended)
    if _NO_COMMENT.match(rest):
        return False
    if not ended:
        return None
    is_blank = not _is_wide(begun) and not text.removeprefix(_MARK).strip()
    return is_blank or b"#" in text


def _is_wide(begun: bytes | bytearray) -> bool:
    return begun.startswith(_WIDE_MARKS)


def _as_utf_8(chunks: Iterable[bytes]) -> Iterator[bytes]:
    """Yield text in UTF-16 as UTF-8."""
    decoder = getincrementaldecoder("utf-16")(errors="replace")
    for chunk in chunks:
        yield decoder.decode(chunk).encode(errors="replace")
    yield decoder.decode(b"", final=True).encode(errors="replace")


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


def text_of(content: bytes) -> str:
    """Return the text of a whole file."""
    return "".join(blocks([content]))


def blocks(chunks: Iterable[bytes]) -> Iterator[str]:
    """Yield the text in whole lines, many at once; an overlong line comes in pieces."""
    rest = iter(chunks)
    begun = b""
    for chunk in rest:
        begun += chunk
        if len(begun) >= len(_MARK):
            break
    if _is_wide(begun):
        return _lines(_as_utf_8(chain([begun], rest)))
    return _lines(chain([begun.removeprefix(_MARK)], rest))


def _lines(chunks: Iterable[bytes]) -> Iterator[str]:
    held = bytearray()
    in_long = False
    for chunk in chunks:
        held += chunk
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
