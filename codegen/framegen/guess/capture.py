"""A recording of a line: raw bytes, or hex as text, in the lines of which frames may stand."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

from framewire.codec.hextext import HexError, read_hex
from framewire.recording.form import LogError, is_text, log_lines, text_of

if TYPE_CHECKING:
    from collections.abc import Iterator

# More bytes than these tell nothing that is new, and take their time.
MOST = 1 << 14


@dataclass(frozen=True)
class Capture:
    """The first bytes of a line, and the pieces in which text has them; a raw file is one piece."""

    data: bytes
    pieces: tuple[bytes, ...]

    @property
    def is_cut(self) -> bool:
        """Whether there are more bytes than are looked at."""
        return sum(map(len, self.pieces)) > len(self.data)

    @property
    def starts(self) -> list[int]:
        """Where the pieces begin that are whole."""
        return [0, *self.ends][:-1]

    @property
    def ends(self) -> list[int]:
        """Where these end."""
        return [end for end in accumulate(map(len, self.pieces)) if end <= len(self.data)]


def read_capture(content: bytes, form: str = "auto") -> Capture:
    """Read the content of a file in one of FORMS: text of hex and comments, or raw bytes.

    Recordings are such text: what they say of senders and times is in comments. Raises ValueError
    for text that is no hex, with its line.
    """
    is_raw = form == "raw" or (form == "auto" and not is_text(content, ended=True))
    pieces = tuple(filter(None, [content] if is_raw else _lines(text_of(content))))
    return Capture(b"".join(pieces)[:MOST], pieces)


def _lines(text: str) -> Iterator[bytes]:
    log = log_lines(text)
    for number, line in enumerate(text.split("\n"), 1):
        try:
            yield read_hex(line if log is None else log.hex_of(line))
        except (HexError, LogError) as error:
            raise ValueError(f"line {number}: {error}") from None
