"""Where frames begin, and how large they are."""

from __future__ import annotations

from .protocol import (
    BODY_AT,
    COMMAND_END,
    HEADER,
    LENGTH_END,
    UNCOUNTED,
    read_command,
    read_length,
)

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .message import Message

HEAD = BODY_AT
"""How many bytes stand in front of the fields."""


def begins(data: bytes, at: int = 0) -> bool:
    """Return whether a frame may begin at data[at], as far as its header goes."""
    return data.startswith(HEADER, at)


def size_of(_: type[Message], length: int) -> int:
    """Return the size of the frames of a message that have this length."""
    return length + UNCOUNTED


def has_ids(kind: type[Message], data: bytes) -> bool:
    """Return whether `data` begins as the frames of a message do, as far as its command."""
    return begins(data) and len(data) >= COMMAND_END and read_command(data) == kind.COMMAND


def claimed(data: bytes) -> int:
    """Return how large the frame would be that `data` begins; 0 where it does not say so."""
    return read_length(data) + UNCOUNTED if begins(data) and len(data) >= LENGTH_END else 0
