"""The bytes of an event, whether it is a message or noise."""

from __future__ import annotations

from .noise import Noise

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from ..frame.message import Message


def bytes_of(event: Message | Noise) -> bytes:
    """Return the bytes of an event, as they are on the wire."""
    return event.data if isinstance(event, Noise) else event.encode()
