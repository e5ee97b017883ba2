"""Whether a line has room for a frame, where it carries no long ones."""

from __future__ import annotations

from .errors import EncodeError
from .protocol import UNCOUNTED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .message import Message


def check_room(message: Message, largest_frame: int | None) -> None:
    """Raises EncodeError for a frame of more bytes than this; None is for a line of any."""
    size = len(message.encode())
    if largest_frame is None or size <= largest_frame:
        return
    why = f"the frame has {size} bytes, and this line carries {largest_frame} at once"
    items = message.SHAPE.items
    if items is None:
        raise EncodeError(type(message).__name__, message, why)
    lengths = zip(items.counts, message.LENGTHS, strict=True)
    most = max((n for n, length in lengths if length + UNCOUNTED <= largest_frame), default=0)
    given = getattr(message, items.name)
    raise EncodeError(items.name, given, f"{why}: room for {most} of {len(given)}")
