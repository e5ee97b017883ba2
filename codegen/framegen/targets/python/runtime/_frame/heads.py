"""Where frames begin, and how large they are."""

from __future__ import annotations

from .envelopes import ENVELOPES

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .message import Message

HEAD = max(1, *(envelope.body_at for envelope in ENVELOPES))
"""How many bytes stand in front of the fields, at the most; 1 if there are none."""
LEAST = min(envelope.least for envelope in ENVELOPES)
"""The size of the smallest frame there may be."""

# How much of a line is searched at once.
_STRETCH = 256
# The header, where all frames have the same; the beginnings of it that more bytes may complete.
_HEADERS = {envelope.header for envelope in ENVELOPES}
_HEADER = _HEADERS.pop() if len(_HEADERS) == 1 else b""
_BEGUN = tuple(_HEADER[:size] for size in range(len(_HEADER) - 1, 0, -1))
FIRST_BYTES = frozenset[int]().union(*(envelope.first_bytes for envelope in ENVELOPES))
"""The bytes with which a frame may begin."""

_OTHERS = bytes({*range(0x100)} - FIRST_BYTES)


def begins(data: bytes, at: int = 0) -> bool:
    """Return whether a frame may begin at data[at], as far as its header goes."""
    return any(envelope.begins(data, at) for envelope in ENVELOPES)


def next_begun(data: bytes, at: int) -> int:
    """Return where from data[at] on a frame may begin; the end if nowhere."""
    if _HEADER:
        found = data.find(_HEADER, at)
        if found >= 0:
            return found
        for begun in _BEGUN:
            if data.endswith(begun, at):
                return len(data) - len(begun)
        return len(data)
    while at < len(data):
        stretch = data[at : at + _STRETCH]
        rest = stretch.lstrip(_OTHERS)
        at += len(stretch) - len(rest)
        if rest:
            break
    return at


def size_of(kind: type[Message], length: int) -> int:
    """Return the size of the frames of a message that have this length."""
    return kind.FRAME.size(length)


def has_ids(kind: type[Message], data: bytes) -> bool:
    """Return whether `data` begins as the frames of a message do, as far as its ids."""
    frame = kind.FRAME
    if not frame.begins(data, 0):
        return False
    parts = zip(frame.ids, kind.IDS, strict=False)
    return all(part.at + part.size <= len(data) and part.read(data) == id_ for part, id_ in parts)


def claimed(data: bytes) -> int:
    """Return how large the frame would be that `data` begins; 0 where it does not say so."""
    for envelope in ENVELOPES:
        length = envelope.length
        if length and envelope.begins(data, 0) and len(data) >= length.at + length.size:
            return envelope.size(length.read(data))
    return 0
