"""A message: the slots of its frames, their lengths, and what is written of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

from .envelope import Envelope
from .places import lay_out
from .slots import Field, List, Number
from .words import Example, Note

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from .places import Placed
    from .slots import Slot

# What follows from where it stands.
_APART = {"apart": True}


@dataclass(frozen=True, kw_only=True)
class Message:
    """One message. What others it has to do with is said by their names.

    `legal` are the lengths that it can have where some of its fields may be absent. `failure` is
    the field by which a reply tells whether the device has failed, unless it is `good`. The last
    ones say how the library sends or makes it; `class_name` is "" where it is the name.
    """

    name: str = field(metadata=_APART)
    envelope: Envelope = field(metadata=_APART)
    ids: tuple[int, ...] = field(metadata=_APART)
    frame: str = ""
    direction: str
    kind: str
    vendor_name: str = ""
    summary: str
    description: str = ""
    notes: tuple[Note, ...] = ()
    deprecated: str = ""
    since: str = ""
    reply: str = ""
    refusal: str = ""
    failure: str = ""
    good: int = 0
    asks_for: str = ""
    reports: tuple[str, ...] = ()
    acknowledged: str = ""
    lasts: str = ""
    answers: tuple[str, ...] = ()
    reports_on: tuple[str, ...] = ()
    cite: str
    fields: tuple[Field, ...]
    legal: tuple[int, ...] = field(default=(), metadata={"key": "lengths"})
    examples: tuple[Example, ...]
    python: tuple[str, ...] = ()
    client: tuple[str, ...] = ()
    shell: tuple[str, ...] = ()
    class_name: str = field(default="", metadata={"key": "class"})
    method: str = ""

    @property
    def seen_ids(self) -> tuple[int, ...]:
        """Those ids that a frame holds."""
        return self.ids[: len(self.envelope.ids)]

    @property
    def unsent_ids(self) -> tuple[int, ...]:
        """Those ids that no frame holds."""
        return self.ids[len(self.envelope.ids) :]

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """The slots from the first byte to the last: those of the envelope around the fields."""
        found: list[Slot] = []
        for slot in self.envelope.slots:
            found += self.fields if slot.role == "body" else [slot]
        return tuple(found)

    @cached_property
    def items(self) -> List | None:
        """The list of a size that varies, where the message has one."""
        lists = (slot for slot in self.fields if isinstance(slot, List) and not slot.is_fixed)
        return next(lists, None)

    @cached_property
    def counter(self) -> Number | None:
        """The field that says how long that list is, where there is one."""
        name = "" if self.items is None else self.items.counter
        named = (slot for slot in self.fields if isinstance(slot, Number) and slot.name == name)
        return next(named, None)

    @cached_property
    def optional(self) -> tuple[Field, ...]:
        """The fields that may be absent, each with those behind it."""
        return tuple(slot for slot in self.fields if isinstance(slot, Number) and slot.optional)

    @cached_property
    def base(self) -> int:
        """The length of a frame without elements, and without what may be absent."""
        sizes = 0
        for slot in self.slots:
            if slot is not self.items and slot not in self.optional:
                many = slot.low if isinstance(slot, List) and slot.is_fixed else 1
                sizes += slot.size * many
        return sizes - self.envelope.uncounted

    @cached_property
    def formula(self) -> str:
        """The length rule: `3 * count + 5`, or a number, or several."""
        if self.items is None:
            return ", ".join(map(str, self.lengths))
        items = self.items
        count = items.variable or items.counter or items.name
        term = count if items.size == 1 else f"{items.size} * {count}"
        return f"{term} + {self.base}" if self.base else term

    @cached_property
    def varies(self) -> bool:
        """Whether its frames have several lengths."""
        return len(self.lengths) > 1

    @cached_property
    def lengths(self) -> Sequence[int]:
        """The legal values of the length."""
        if self.items is None:
            return self.legal or range(self.base, self.base + 1)
        size = self.items.size
        low, high = (self.base + size * count for count in (self.items.low, self.items.high))
        return range(low, high + 1, size)

    @property
    def largest(self) -> int:
        """The size of the largest legal frame in bytes."""
        return self.lengths[-1] + self.envelope.uncounted

    def count_at(self, length: int) -> int:
        """Return the number of elements of a frame with this legal length."""
        return 0 if self.items is None else self.items.low + self.lengths.index(length)

    def counted_at(self, counter: Number, length: int) -> int:
        """Return the value of a counter of the list in a frame with this legal length."""
        size = self.items.size if self.items is not None and counter.role == "size" else 1
        return self.count_at(length) * size

    def lay_out(self, length: int) -> Iterator[Placed]:
        """Place the slots of a frame with this legal length, from its first byte on."""
        count = self.count_at(length)
        size = length + self.envelope.uncounted
        end = size - sum(slot.size for slot in self.slots if slot.at < 0)
        there = [slot for slot in self.slots if slot not in self.optional or slot.at < end]
        return lay_out(there, size, count)
