"""Reads single frames: from bytes to the message that they are, or the reason why they are none."""

from __future__ import annotations

from .direction import Direction
from .messages import MESSAGES
from .protocol import BODY_AT
from .table import Table

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .message import Message

_new = object.__new__

# Made once: to make it takes as long as to use it.
_HEAD = slice(BODY_AT)

_tables: dict[Direction | None, Table] = {}


def table_for(direction: Direction | None) -> Table:
    """The messages of one direction, or of both for None. Raises TypeError for anything else."""
    table = _tables.get(direction)
    if table is None:
        if direction is not None and not isinstance(direction, Direction):
            raise TypeError(
                f"a Direction expected, such as {next(iter(Direction))}, not {direction!r}"
            )
        kinds = [kind for kind in MESSAGES if direction in (None, kind.DIRECTION)]
        table = _tables[direction] = Table(kinds)
    return table


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
            size, at, until, count, kind = entry
            if len(frame) == size and (not until or frame[at:until] == count):
                message = _new(kind)
                message._frame = frame
                return message
    return table.read(frame)
