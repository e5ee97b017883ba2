"""A hint for a capture that is mostly noise: it may be of a protocol that looks alike, or text."""

from __future__ import annotations

import sys

from ..codec.event_bytes import bytes_of
from .plain_text import plain_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from .recording import Recording

ENOUGH = 16384
"""Bytes enough to recognise another protocol by."""


def beginning(recording: Recording, form: str, direction: Direction | None) -> bytes:
    """Return how the bytes of a recording begin; nothing if it cannot be read again."""
    begun = b""
    if recording.again:
        for entry in recording.entries(form, direction):
            begun += bytes_of(entry.event)
            if len(begun) >= ENOUGH:
                break
    return begun


def hint(begun: bytes, codec: ProtocolCodec) -> None:
    """Say on the error stream which protocol the bytes look like, or that they are text."""
    found = codec.recognise(begun)
    text = plain_text(begun)
    if found is not None:
        title = found.removeprefix("The ")
        print(f"hint: most of it is noise; it looks like the {title}", file=sys.stderr)
    elif text:
        print(f"hint: most of it is noise; it is text: {text}", file=sys.stderr)
