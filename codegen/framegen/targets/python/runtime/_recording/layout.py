"""The messages of the protocol as tables need them: what stands where, and under which name."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache, cached_property
from typing import TYPE_CHECKING

from .._codec.codec import table_for
from .._explanation.carried_model import classes, protocol
from .._frame.direction import Direction
from .._frame.errors import Reason
from .._frame.free_name import free_name
from ..messages import MESSAGES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from .._explanation.protocol import Message as Described
    from .._explanation.protocol import Protocol, Slot
    from .._frame.message import Message

# Arrays hold directions and reasons as indices into these.
DIRECTIONS = tuple(Direction)
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
    """One message: its class, which is so many in MESSAGES, and its slots as the model has them."""

    number: int
    kind: type[Message]
    described: Described

    @property
    def name(self) -> str:
        """The name of its class, and of its table."""
        return self.kind.__name__

    @property
    def direction(self) -> int:
        """Its direction, an index into DIRECTIONS."""
        return DIRECTIONS.index(self.kind.DIRECTION)

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
        return slot.role == "packed" or (slot.role == "list" and "text" not in slot.said)

    @property
    def fields(self) -> list[Slot]:
        """What an element of a list holds, without what never changes."""
        return [slot for slot in self.slot.fields if slot.role in ("field", "text")]


def _attribute(name: str, given: Sequence[str]) -> str:
    """Return the attribute of a field: its name, or another where Python has taken that."""
    return name if name in given else f"{name}_"


def messages_on(direction: Direction | None) -> list[Layout]:
    """Return the messages of one direction, or of both; in the order in which decoders try them."""
    by_kind = {each.kind: each for each in layouts()}
    return [by_kind[kind] for kind in table_for(direction).messages]


@cache
def described() -> Protocol:
    """Return the model of the protocol; read once."""
    return protocol(__name__.partition("._recording")[0])


@cache
def layouts() -> tuple[Layout, ...]:
    """Return all messages, in the order of MESSAGES."""
    model = described()
    names = {there: name for name, there in classes(model).items()}
    return tuple(
        Layout(number, kind, model.messages[names[kind.__name__]])
        for number, kind in enumerate(MESSAGES)
    )


def table_names() -> list[str]:
    """Return the names of all tables: one a message, and that of noise."""
    return [*(each.name for each in layouts()), NOISE]


@cache
def unknown_columns() -> dict[str, tuple[str, int]]:
    """Return columns and sizes of the numbers that tell unknown frames apart, by their names."""
    sizes: dict[str, int] = {}
    for envelope in described().envelopes.values():
        for slot in envelope.slots:
            if slot.role in ("address", "id"):
                sizes[slot.name] = max(slot.size, sizes.get(slot.name, 0))
    taken = (*EVENT_COLUMNS, REASON_COLUMN, UNKNOWN_COLUMN, PARAMETERS)
    return {name: (free_name(name, taken), size) for name, size in sizes.items()}
