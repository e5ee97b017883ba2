"""Decode single frames: from bytes to the message that they are, or to the reason why not."""

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

# Made once: making it takes as long as using it.
_HEAD = slice(BODY_AT)

_tables: dict[Direction | None, Table] = {}


def table_for(direction: Direction | None, max_frame: int | None = None) -> Table:
    """Return the messages of one direction, of both for None, in frames up to `max_frame` bytes.

    Raises TypeError for a value that is no direction or no number, ValueError if no frame is that
    small.
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
    """Decode one frame, complete and with nothing after it, sent in `direction`.

    With None it may be of either direction; a frame that is legal in both is read in the direction
    that is declared first. Raises DecodeError, which gives the reason and the offset.
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
    """Return the other messages that the same frame may be, if its sender is unknown."""
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
