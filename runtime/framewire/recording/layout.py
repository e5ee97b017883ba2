"""The messages of the protocol as tables need them: what stands where, and under which name."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import TYPE_CHECKING

from ..frame.errors import Reason
from ..frame.free_name import free_name
from ..protocol.slots import Constant, List, Packed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..frame.message import Message
    from ..protocol.message import Message as Described
    from ..protocol.protocol import Protocol
    from ..protocol.slots import Number, Slot, Text

# Arrays hold reasons as indices into these.
REASONS = tuple(Reason)
# By name: a protocol has only the reasons that it needs.
REASON_NUMBERS = {reason.name: number for number, reason in enumerate(REASONS)}

# What every table says of an event; a field of such a name has a `_` behind it.
EVENT_COLUMNS = ("offset", "size", "direction", "time", "clock")
NOISE = "noise"
"""The name of the table of what is no message."""
# Its columns behind those of every event, and the last one.
REASON_COLUMN, UNKNOWN_COLUMN, PARAMETERS = "reason", "unknown", "parameters"
# What a user gives, rather than what follows from it.
_GIVEN = ("field", "text", "packed", "list", "address", "counter")


@dataclass(frozen=True, eq=False)
class Layout:
    """One message: its class, and its slots as the model has them.

    `number` is its place among all messages, and `direction` that of its own among all directions.
    """

    number: int
    kind: type[Message]
    direction: int
    described: Described

    @property
    def name(self) -> str:
        """The name of its class, and of its table."""
        return self.kind.__name__

    @property
    def tail_size(self) -> int:
        """The number of bytes behind its fields."""
        return sum(slot.size for slot in self.described.slots if slot.at < 0)

    @cached_property
    def columns(self) -> tuple[Column, ...]:
        """A column for each field that a user gives."""
        slots = [slot for slot in self.described.slots if slot.role in _GIVEN]
        attributes = [_attribute(slot.name, self.kind.__match_args__) for slot in slots]
        return tuple(
            Column(attribute, free_name(attribute, EVENT_COLUMNS), slot)
            for attribute, slot in zip(attributes, slots, strict=True)
        )

    def element_names(self, column: Column) -> tuple[str, ...]:
        """Return the names of the fields in an element of a list; none if it has bare numbers."""
        element = getattr(getattr(self.kind, column.attribute), "element", None)
        return () if element is None else element.__match_args__


@dataclass(frozen=True, eq=False)
class Column:
    """One field of a message: the attribute of its class, the name of the column, and its slot."""

    attribute: str
    name: str
    slot: Slot

    @property
    def is_list(self) -> bool:
        """Whether it holds several values; characters are one text."""
        slot = self.slot
        return isinstance(slot, Packed) or (isinstance(slot, List) and not slot.text)

    @property
    def fields(self) -> list[Number | Text]:
        """What an element of a list holds, without what never changes."""
        slots = self.slot.fields if isinstance(self.slot, List) else ()
        return [slot for slot in slots if not isinstance(slot, Constant)]


def _attribute(name: str, given: Sequence[str]) -> str:
    """Return the attribute of a field: its name, or another where Python has taken that."""
    return name if name in given else f"{name}_"


class Layouts:
    """All messages of a protocol, as tables need them.

    Arrays hold messages and directions as indices: into `every`, and into `directions`.
    """

    def __init__(self, codec: ProtocolCodec) -> None:
        self._codec = codec
        self.directions: tuple[Direction, ...] = tuple(codec.directions)

    @cached_property
    def described(self) -> Protocol:
        """The model of the protocol; read once."""
        return self._codec.protocol()

    @cached_property
    def every(self) -> tuple[Layout, ...]:
        """All messages, in the order in which they are declared."""
        model = self.described
        names = {there: name for name, there in model.classes.items()}
        ways = {way: at for at, way in enumerate(self.directions)}
        return tuple(
            Layout(number, kind, ways[kind.DIRECTION], model.messages[names[kind.__name__]])
            for number, kind in enumerate(self._codec.messages)
        )

    def on(self, direction: Direction | None) -> list[Layout]:
        """Return the messages of one direction, or of both, in the order in which all try them."""
        by_kind = {each.kind: each for each in self.every}
        return [by_kind[kind] for kind in self._codec.table_for(direction).messages]

    @property
    def names(self) -> list[str]:
        """The names of all tables: one a message, and that of noise."""
        return [*(each.name for each in self.every), NOISE]

    @cached_property
    def unknown_columns(self) -> dict[str, tuple[str, int]]:
        """Columns and sizes of the numbers that tell unknown frames apart, by their names."""
        sizes: dict[str, int] = {}
        for envelope in self.described.envelopes.values():
            for slot in envelope.slots:
                if slot.role in ("address", "id"):
                    sizes[slot.name] = max(slot.size, sizes.get(slot.name, 0))
        taken = (*EVENT_COLUMNS, REASON_COLUMN, UNKNOWN_COLUMN, PARAMETERS)
        return {name: (free_name(name, taken), size) for name, size in sizes.items()}


@cache
def layouts_of(codec: ProtocolCodec) -> Layouts:
    """Return the messages of a protocol; made once."""
    return Layouts(codec)
