"""Which protocols are searched at many places at once; all others are read in order."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from ...recording.layout import layouts_of
from .checksums import is_summed
from .legal import LegalFrames
from .shape import is_testable

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ...protocol.envelope import Envelope
    from ...recording.layout import Layout

_IN_FRONT = ("constant", "length", "id", "address", "counter")
_COMPARED = ("length", "id", "address", "checksum")
# Larger ones have no room in the numbers that are worked with.
_WIDEST = 4


@cache
def frames_on(codec: ProtocolCodec, direction: Direction | None) -> LegalFrames | None:
    """Return the frames on a line, if they can be found at many places at once; None if not."""
    messages = layouts_of(codec).on(direction)
    return LegalFrames(messages) if is_searchable(messages) else None


def is_searchable(messages: Sequence[Layout]) -> bool:
    """Tell whether these messages can be found at many places at once.

    Their frames begin with the same constant, say how long they are and which message they are in
    front of the fields, and have nothing behind them but checksums that are worked out at once.
    """
    envelopes = {each.described.envelope.name: each.described.envelope for each in messages}
    return (
        len(envelopes) == 1
        and all(map(_is_regular, envelopes.values()))
        and all(is_testable(slot) for each in messages for slot in each.described.fields)
    )


def _is_regular(envelope: Envelope) -> bool:
    roles = [placed.slot.role for placed in envelope.head]
    constants = sum(placed.slot.size for placed in envelope.head if placed.slot.role == "constant")
    behind = [slot for slot in envelope.slots if slot.at < 0]
    return (
        bool(envelope.header)
        # What a frame of an unknown id claims, and no checksum proves, is held to the header alone.
        and (constants == len(envelope.header) or bool(envelope.checksums))
        and {"length", "id"} <= {*roles} <= {*_IN_FRONT}
        and all(slot.size <= _WIDEST for slot in envelope.slots if slot.role in _COMPARED)
        and not envelope.unsent
        and all(slot.role == "checksum" for slot in behind)
        and all(is_summed(envelope, part) for part in envelope.checksums)
    )
