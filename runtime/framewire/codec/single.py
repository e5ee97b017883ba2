"""Decode single frames: from bytes to the message that they are, or to the reason why not."""

from __future__ import annotations

from ..frame.direction import Direction
from ..frame.message import Message
from ..frame.table import measured

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..frame.table import Table
    from .protocol_codec import ProtocolCodec

_new = object.__new__


def decoding(
    codec: ProtocolCodec,
) -> Callable[[bytes | bytearray | memoryview, Direction | None], Message]:
    """Return the function that decodes one frame of a protocol."""
    # Looked up in a cell, not in an object: that would take a tenth of the time.
    tables: dict[Direction | None, Table] = {}
    head, total = slice(codec.heads.longest), codec.heads.total

    def decode(frame: bytes | bytearray | memoryview, direction: Direction | None) -> Message:
        """Decode one frame, complete and with nothing after it, sent in `direction`.

        With None it may be of either direction; a frame that is legal in both is read in the
        direction that is declared first. Raises DecodeError, which gives the reason and the offset.
        """
        try:
            table = tables[direction]
        except KeyError:
            table = tables[direction] = codec.table_for(direction)
        # What `read` does with a frame of a kind seen before; the call alone would cost a fifth.
        if type(frame) is bytes:
            entry = table.get(frame[head])
            while entry is not None:
                size, at, until, count, kind, holds, _ = entry
                if (
                    len(frame) == size
                    and (not count or frame[at:until] == count)
                    and (total is None or sum(frame) & 0xFF == total)
                    and (holds is None or holds(frame))
                ):
                    message = _new(kind)
                    message._frame = frame
                    return message
                # Of some, only the count says how long they are.
                entry = None if size else measured(entry, frame, 0)
        return table.read(frame)

    return decode
