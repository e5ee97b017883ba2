"""A recording of a line: raw bytes, or hex as text, in the lines of which frames may stand."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate

from framegen.hextext import HexError, read_hex

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


def read_capture(content: bytes) -> Capture:
    """Read the content of a file: text of nothing but hex and comments, or else raw bytes.

    Recordings are such text: what they say of senders and times is in comments.
    """
    try:
        lines = content.decode("ascii").splitlines()
        pieces = tuple(filter(None, map(read_hex, lines)))
    except (UnicodeDecodeError, HexError):
        pieces = (content,) if content else ()
    return Capture(b"".join(pieces)[:MOST], pieces)
