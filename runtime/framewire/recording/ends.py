"""The ends of a line: who sends, and in which directions."""

from __future__ import annotations

from functools import cache

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction


class Ends:
    """The ends of a protocol.

    `ways` are the directions in which each sends: several where it talks to several others. `only`
    is the direction of whoever sends in one alone, and None for others, and for None.
    """

    __slots__ = ("codec", "only", "ways")

    def __init__(self, codec: ProtocolCodec) -> None:
        self.codec = codec
        every = list(codec.directions)
        self.ways = {who: [way for way in every if way.sender == who] for who in codec.senders}
        self.only: dict[str | None, Direction | None] = {None: None}
        for who, ways in self.ways.items():
            self.only[who] = ways[0] if len(ways) == 1 else None


@cache
def ends_of(codec: ProtocolCodec) -> Ends:
    """Return the ends of a protocol; worked out once."""
    return Ends(codec)
