"""Reads single frames: from bytes to the message that they are, or the reason why they are none."""

from __future__ import annotations

from operator import index

from .._frame.direction import Direction
from .._frame.protocol import BODY_AT
from .._frame.table import Table, largest_of
from ..messages import MESSAGES

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .._frame.message import Message

_new = object.__new__

# Made once: to make it takes as long as to use it.
_HEAD = slice(BODY_AT)

_tables: dict[Direction | None, Table] = {}


def table_for(direction: Direction | None, max_frame: int | None = None) -> Table:
    """The messages of one direction, or of both for None, in frames of at most `max_frame` bytes.

    Raises TypeError for what is no direction or no number, ValueError where no frame is so small.
    """
    table = _tables.get(direction)
    if table is None:
        if direction is not None and not isinstance(direction, Direction):
            raise TypeError(
                f"a Direction expected, such as {next(iter(Direction))}, not {direction!r}"
            )
        kinds = [kind for kind in MESSAGES if direction in (None, kind.DIRECTION)]
        table = _tables[direction] = Table(kinds, largest_of(kinds))
    if max_frame is None or index(max_frame) >= table.largest:
        return table
    if max_frame < BODY_AT:
        raise ValueError(f"max_frame is {max_frame}, and the smallest frame has {BODY_AT} bytes")
    return Table(table.messages, index(max_frame))


def decode(frame: bytes | bytearray | memoryview, direction: Direction | None) -> Message:
    """Reads one frame, whole and with nothing after it, sent in `direction`.

    With None it may be of either direction; a frame that is legal in both is the first's, which is
    the one declared first. Raises DecodeError, which tells the reason and the offset.
    """
    try:
        table = _tables[direction]
    except KeyError:
        table = table_for(direction)
    # What `read` does with a frame of a kind seen before; the call alone would cost a fifth more.
    if type(frame) is bytes:
        entry = table.get(frame[_HEAD])
        if entry is not None:
            size, at, until, count, kind, _ = entry
            if len(frame) == size and (not count or frame[at:until] == count):
                message = _new(kind)
                message._frame = frame
                return message
    return table.read(frame)


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
