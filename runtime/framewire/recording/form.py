"""Distinguish a text recording from raw bytes, by how it begins, and read its text in lines.

Whatever reads a capture asks here.
"""

from __future__ import annotations

import re
from codecs import getincrementaldecoder
from datetime import date
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

# Lines as terminals, loggers and tables have them. A bracketed time alone makes such a line: a bare
# one may be bytes.
_CLOCK = (
    r"(?P<{}>(?:[0-9]{{4}}-[0-9]{{2}}-[0-9]{{2}}[ T])?"
    r"[0-9]{{2}}(?::[0-9]{{2}}){{2}}(?:[.,][0-9]{{1,9}})?)"
)
_MONITORED = re.compile(
    rf"\s*(?:{_CLOCK.format('at')}(?:\s*->|(?=\s+[TR]X\s*:))|\[{_CLOCK.format('in_brackets')}\])?"
    r"\s*(?:(?P<way>[TR]X)\s*:)?\s*(?P<said>.*)",
    re.IGNORECASE,
)
_LEVEL = r"(?:DEBUG|INFO|WARNING|ERROR|CRITICAL)"
_LOGGED = re.compile(
    rf"\s*(?:{_CLOCK.format('at')}\s+(?:-\s+)?(?:{_LEVEL}\s+[\w.-]+:|[\w.-]+\s+-\s+{_LEVEL}\s+-)"
    rf"|{_LEVEL}:[\w.-]+:)\s*(?P<said>.*)"
)
_LITERAL = re.compile(r"""b(?:'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")""")
_ESCAPED = re.compile(r"(?:[ -\[\]-~]|\\(?:x[0-9A-Fa-f]{2}|[0-7]{1,3}|[abfnrtv'\"\\]))*")
_BYTES_BEGIN = re.compile(r"(?:b['\"]|(?:0[xX]|\\x)?[0-9A-Fa-f]{2}(?![G-Zg-z]))")
# Letters alone are a word rather than bytes; unless they are one byte.
_BYTES_WORD = re.compile(r"(?:(?:0[xX])?(?=[A-Fa-f]*[0-9]|..$)(?:[0-9A-Fa-f]{2})+,?)")
_SENT = {"tx", "sent", "send", "sends", "sending", "write", "writing", "wrote", "written"}
_CAME = {"rx", "received", "receive", "receiving", "recv", "read", "reading", "got"}
_TABLE_TIMES = {"t", "time", "timestamp", "time [s]", "time (s)", "t [s]", "t_s", "time_s"}
_SECONDS = re.compile(r"[0-9]{1,9}\.[0-9]{1,9}")


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
    digits; or it begins a line that has the form of a recording or of a log. Without a word, a
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
        text = line.decode("ascii")
        return TIMED_LINE.match(text) is not None or log_lines(text) is not None
    return None


class LogError(ValueError):
    """A line of a log that says no bytes, or not clearly which."""


def log_lines(text: str) -> LogLines | None:
    """Return a reader of lines like the first with bytes of a text; None if that is no log.

    A log is what a serial monitor, Python's logging, or a table of two wires says of a line:
    `12:01:02.123 -> 01 02`, `TX: 01 02`, `... DEBUG x: sent b'AB'`, `t;tx;rx`.
    """
    lines = (line for line in text.split("\n") if line.partition("#")[0].strip())
    first = next(lines, "")
    if len(first) >= LONGEST_LINE or TIMED_LINE.match(first):
        return None
    return _table(first) or _log(first)


def without_log(text: str) -> str:
    """Return the hex alone of a text that may be a log, line by line. Raises LogError."""
    log = log_lines(text)
    return text if log is None else "\n".join(map(log.hex_of, text.split("\n")))


class LogLines:
    """A reader of the lines of a log, which holds the clock of the first."""

    def __init__(self) -> None:
        self._began: float | None = None
        self._last = 0.0

    def read(self, line: str) -> list[tuple[str, float | None, str]]:
        """Return what a line says: the hex, the seconds since the first, `tx`, `rx` or nothing.

        Raises LogError, which says what is wrong with the line.
        """
        if not line.partition("#")[0].strip():
            return []
        logged = _LOGGED.match(line)
        if logged is not None:
            text, way = _said(logged["said"])
            return [(text, self._seconds(logged["at"]), way)]
        found = _MONITORED.match(line)
        if found is None or not (found["at"] or found["in_brackets"] or found["way"]):
            raise LogError(
                "it is no line of a log, with a time or a direction, and other lines are"
            )
        said = found["said"].strip()
        if _LITERAL.fullmatch(said):
            said = _hex_of(said)
        return [(said, self._seconds(found["at"] or found["in_brackets"]), _lower(found["way"]))]

    def hex_of(self, line: str) -> str:
        """Return the hex of a line alone. Raises LogError."""
        return " ".join(text for text, _, _ in self.read(line))

    def _seconds(self, clock: str | None) -> float | None:
        if clock is None:
            return None
        day, _, time = clock.replace("T", " ").rpartition(" ")
        hours, minutes, seconds = time.replace(",", ".").split(":")
        at = int(hours) * 3600 + int(minutes) * 60 + float(seconds) + 86400 * _days(day)
        # A clock without a day goes on after midnight.
        while not day and at < self._last - 43200:
            at += 86400
        self._last = at
        return self._since(at)

    def _since(self, at: float) -> float:
        if self._began is None:
            self._began = at
        return round(at - self._began, 9)


class _Table(LogLines):
    """A reader of a table whose columns are the wires."""

    def __init__(self, head: str, mark: str, names: list[str]) -> None:
        super().__init__()
        self._head, self._mark, self._size = head, mark, len(names)
        self._wires = [(way, names.index(way)) for way in ("tx", "rx") if way in names]
        self._time = next((at for at, name in enumerate(names) if name in _TABLE_TIMES), None)

    def read(self, line: str) -> list[tuple[str, float | None, str]]:
        if not line.partition("#")[0].strip() or line == self._head:
            return []
        cells = [cell.strip().strip('"') for cell in line.split(self._mark)]
        if len(cells) != self._size:
            problem = f"it has {len(cells)} columns, and the header has {self._size}"
            raise LogError(problem)
        at = None if self._time is None else self._time_of(cells[self._time])
        return [(cells[wire], at, way) for way, wire in self._wires if cells[wire]]

    def _time_of(self, cell: str) -> float | None:
        if _SECONDS.fullmatch(cell):
            return self._since(float(cell))
        return self._seconds(cell) if re.fullmatch(_CLOCK.format("at"), cell) else None


def _table(first: str) -> LogLines | None:
    mark = next((mark for mark in ";,\t" if mark in first), None)
    names = [name.strip().strip('"').lower() for name in first.split(mark)] if mark else []
    if not {"tx", "rx"} & {*names} or len({*names}) < len(names):
        return None
    return _Table(first, mark or "", names)


def _log(first: str) -> LogLines | None:
    logged = _LOGGED.match(first)
    if logged is not None and logged["at"] is None:
        try:
            _said(logged["said"])
        except LogError:
            return None
    found = _MONITORED.match(first)
    marked = found is not None and (found["at"] or found["in_brackets"] or found["way"])
    is_monitored = found is not None and marked and _BYTES_BEGIN.match(found["said"])
    return LogLines() if logged is not None or is_monitored else None


def _said(message: str) -> tuple[str, str]:
    """Return the hex in what somebody logged, and the way that it went. Raises LogError."""
    literals = [*_LITERAL.finditer(message)]
    if len(literals) > 1:
        raise LogError(
            "it has several bytes literals, and nothing says which of them was on the line"
        )
    if literals:
        return _hex_of(literals[0].group()), _way(message[: literals[0].start()].split())
    words = message.split()
    begin = len(words)
    while begin and _BYTES_WORD.fullmatch(words[begin - 1]):
        begin -= 1
    before = words[:begin]
    if begin == len(words):
        raise LogError(
            "it is a line of a log without bytes at its end; remove it, or put a # before it"
        )
    if before and not before[-1].endswith(":") and before[-1].lower() not in _SENT | _CAME:
        problem = f"{before[-1]!r} stands before {words[begin]!r}, so that this may be no byte"
        raise LogError(f"{problem}; put `sent`, `received` or a colon between them")
    return " ".join(words[begin:]), _way(before)


def _way(words: list[str]) -> str:
    """Return the way that words name; nothing where they name both, or none."""
    said = {word.strip(":,").lower() for word in words}
    sent, came = bool(said & _SENT), bool(said & _CAME)
    return "" if sent == came else "tx" if sent else "rx"


def _hex_of(literal: str) -> str:
    if _ESCAPED.fullmatch(literal[2:-1]) is None:
        raise LogError(f"{literal[:40]!r} is no bytes literal of Python")
    try:
        text = literal[2:-1].encode("ascii").decode("unicode_escape")
        return text.encode("latin-1").hex(" ")
    except ValueError:  # an octal number that is no byte
        raise LogError(f"{literal[:40]!r} is no bytes literal of Python") from None


def _days(day: str) -> int:
    try:
        return date.fromisoformat(day).toordinal() if day else 0
    except ValueError:
        raise LogError(f"{day} is no day") from None


def _lower(way: str | None) -> str:
    return (way or "").lower()


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
