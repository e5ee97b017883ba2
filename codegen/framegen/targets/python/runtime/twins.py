"""Frames that a message of either end may be: the same command, and the same bytes."""

from __future__ import annotations

from .codec import table_for
from .protocol import BODY_AT

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .message import Message


def twins(message: Message) -> list[type[Message]]:
    """The other messages that the same frame may be, where nobody knows who has sent it."""
    frame = message.encode()
    table = table_for(None)
    entry = table.get(frame[:BODY_AT])
    if entry is not None and entry[-1] is None:
        return []
    return [
        kind
        for _, count_at, count_end, count, kind, _ in table.entries(frame[:BODY_AT])
        if kind is not type(message)
        and frame[count_at:count_end] == count
        and kind.SHAPE.out_of_range(frame) is None
    ]
