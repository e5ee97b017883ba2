"""The codec of a protocol, as the runtime sees it: directions, messages, and what reads frames."""

from __future__ import annotations

from functools import cached_property
from operator import index

from ..part import part_of

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable

    from ..frame.direction import Direction
    from ..frame.heads import Heads
    from ..frame.message import Message
    from ..frame.table import Table
    from ..protocol.protocol import Protocol
    from .careful_decoder import CarefulDecoder
    from .decoder import StreamDecoder
    from .lookalike import Lookalike
    from .noise import UnknownFrame
    from .noise_lane import NoiseLane


class ProtocolCodec:
    """What a generated library hands to whatever reads frames.

    `package` is its import name. `directions` are all there are, and `received` is that of the
    messages that come to the end that a client is at. What takes time to import is imported when it
    is first asked for.
    """

    def __init__(self, package: str, *, directions: type[Direction], received: Direction) -> None:
        self.package = package
        self.directions = directions
        self.received = received
        self._tables: dict[Direction | None, Table] = {}

    @cached_property
    def senders(self) -> list[str]:
        """The names of both ends, of the first to send first."""
        return list(dict.fromkeys(way.sender for way in self.directions))

    @cached_property
    def named(self) -> dict[str, Direction]:
        """The directions as they are asked for: by the sender alone where that is enough."""
        every = [way.sender for way in self.directions]
        return {
            way.sender if every.count(way.sender) == 1 else way.value: way
            for way in self.directions
        }

    @cached_property
    def messages(self) -> tuple[type[Message], ...]:
        """All messages, in the order in which they are declared."""
        return tuple(part_of(self.package, "messages").MESSAGES)

    @cached_property
    def heads(self) -> Heads:
        """The beginnings of all frames: the envelopes, and what follows from them."""
        heads: Heads = part_of(self.package, "_envelopes").HEADS
        return heads

    @cached_property
    def decoder(self) -> type[StreamDecoder]:
        """What decodes a stream of bytes."""
        decoder: type[StreamDecoder] = part_of(self.package, "_codec").StreamDecoder
        return decoder

    @cached_property
    def unknown_frame(self) -> type[UnknownFrame]:
        """The class of frames with a command that the protocol does not know."""
        unknown: type[UnknownFrame] = part_of(self.package, "_codec").UnknownFrame
        return unknown

    @cached_property
    def lookalikes(self) -> tuple[Lookalike, ...]:
        """The protocols that are easily taken for this one."""
        known: tuple[Lookalike, ...] = part_of(self.package, "_lookalikes").LOOKALIKES
        return known

    @cached_property
    def decode(self) -> Callable[[bytes | bytearray | memoryview, Direction | None], Message]:
        """The function that decodes one frame."""
        from .single import decoding

        return decoding(self)

    def twins(self, message: Message) -> list[type[Message]]:
        """Return the other messages that the same frame may be, if its sender is unknown."""
        found = self.table_for(None).all_of(message.encode())
        return [kind for kind in found if kind is not type(message)]

    def table_for(self, direction: Direction | None, max_frame: int | None = None) -> Table:
        """Return the messages of one direction, of all for None, in frames up to `max_frame` bytes.

        Raises TypeError for a value that is no direction or no number, ValueError if no frame is
        that small.
        """
        table = self._tables.get(direction)
        if table is None:
            table = self._tables[direction] = self._table_of(direction)
        if max_frame is None or index(max_frame) >= table.largest:
            return table
        if max_frame < self.heads.least:
            problem = f"max_frame is {max_frame}, and the smallest frame has"
            raise ValueError(f"{problem} {self.heads.least} bytes")
        return type(table)(table.messages, index(max_frame), self.heads)

    def _table_of(self, direction: Direction | None) -> Table:
        """Make the table of one direction, or of both."""
        from ..frame.table import Table, largest_of

        ways = self.directions
        if direction is not None and not isinstance(direction, ways):
            example = next(iter(ways))
            raise TypeError(f"a Direction expected, such as {example}, not {direction!r}")
        # One direction after the other: of equal frames, that of the first is preferred.
        chosen = ways if direction is None else [direction]
        kinds = [kind for way in chosen for kind in self.messages if kind.DIRECTION is way]
        return Table(kinds, largest_of(kinds), self.heads)

    def careful_decoder(self, direction: Direction | None) -> CarefulDecoder:
        """Return what decodes a stream of bytes for those who can wait for what decides."""
        from .careful_decoder import CarefulDecoder

        return CarefulDecoder(self, direction)

    def noise_lane(self, table: Table) -> NoiseLane:
        """Return what tells frames of unknown command from other noise, among some messages."""
        from .noise_lane import NoiseLane

        return NoiseLane(table, self.unknown_frame)

    def recognise(
        self, data: bytes | bytearray | memoryview, *, by_checksum: bool = False
    ) -> str | None:
        """Return the title of the look-alike whose frames `data` holds; None if it holds few.

        At least half of the bytes must be such frames, and none of them a message of this protocol.
        If the look-alike has a checksum, it proves each frame; if it has none, its commands do,
        unless all are to be proven `by_checksum`.
        """
        from ..frame.bytes_like import as_bytes
        from .lookalike import most_likely

        among = [each for each in self.lookalikes if each.checksums or not by_checksum]
        return most_likely(among, as_bytes(data), self)

    def protocol(self) -> Protocol:
        """Read all that is known of the protocol, for whoever explains it."""
        from ..protocol.form import carried_by

        return carried_by(self.package)
