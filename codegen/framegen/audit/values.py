"""The values that a recording has of each field, and how much of what is documented they cover."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from framegen.model.slots import Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.spec import NumberField
    from framegen.model.layout import MessageLayout

# More different values than these are not told apart, but for those with names.
MOST = 1 << 12


@dataclass
class Values:
    """The values of one field, by its path: `time_ms`, or `targets.position` in every element.

    `low` and `high` are what is documented, None for text. Of a list, its number of elements.
    """

    path: str
    low: float | None = None
    high: float | None = None
    named: dict[str, int] = field(default_factory=dict)
    limits: tuple[int, int | None] | None = None
    bits: int | None = None
    set_bits: int = 0
    is_set: bool = False
    is_size: bool = False
    seen: int = 0
    lowest: Any = None
    highest: Any = None
    counts: Counter[Any] = field(default_factory=Counter)

    def add(self, value: Any) -> None:
        """Count a value."""
        self.seen += 1
        if self.bits is not None:
            self.set_bits |= int(value)
        if len(self.counts) < MOST or value in self.counts or value in self.named.values():
            self.counts[value] += 1
        if isinstance(value, float) and not math.isfinite(value):
            return
        if self.lowest is None or value < self.lowest:
            self.lowest = value
        if self.highest is None or value > self.highest:
            self.highest = value

    @property
    def has_low(self) -> bool:
        """Whether the lowest value documented was seen."""
        return self.seen > 0 and self.lowest == self.low

    @property
    def has_high(self) -> bool:
        """Whether the highest value documented was seen."""
        return self.seen > 0 and self.highest == self.high

    @property
    def named_seen(self) -> list[str]:
        """The names of those values that have one and were seen."""
        return [name for name, value in self.named.items() if value in self.counts]

    @property
    def unnamed(self) -> dict[int, int]:
        """Values without a name, where all that are documented have one, and how often."""
        if not self.is_set:
            return {}
        known = set(self.named.values())
        return {value: count for value, count in self.counts.items() if value not in known}

    @property
    def unknown_bits(self) -> int:
        """The bits that were set and have no name, where any have one."""
        return 0 if self.bits is None else self.set_bits & ~self.bits

    @property
    def beyond_limits(self) -> dict[int, int]:
        """Values that a client refuses to send unless told otherwise, and how often."""
        if self.limits is None:
            return {}
        low, high = self.limits
        return {
            value: count
            for value, count in self.counts.items()
            if (value < low or (high is not None and value > high))
            and value not in self.named.values()
        }


def values_of_layout(message: MessageLayout) -> dict[str, Values]:
    """Return what is documented of each field of a message, in the order of the frame."""
    found: dict[str, Values] = {}
    for slot in message.arguments:
        match slot:
            case Number():
                found[slot.name] = _of_number(slot.name, slot)
            case Text():
                found[slot.name] = Values(slot.name)
            case Packed():
                found[slot.name] = _of_field(slot.name, slot.field, slot.low, slot.high)
            case Items():
                if not slot.is_fixed:
                    found[slot.name] = Values(slot.name, slot.low, slot.high, is_size=True)
                if slot.text is not None:
                    continue
                for inner in slot.fields:
                    path = f"{slot.name}.{inner.name}" if slot.element else f"{slot.name}[]"
                    found[path] = (
                        Values(path) if isinstance(inner, Text) else _of_number(path, inner)
                    )
    return found


def each_value(message: MessageLayout, values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield every value of a message with the path of its field; nothing for what is absent."""
    for slot in message.arguments:
        value = values[slot.name]
        if value is None:
            continue
        if isinstance(slot, Packed):
            yield from ((slot.name, each) for each in value)
        elif not isinstance(slot, Items):
            yield slot.name, value
        else:
            if not slot.is_fixed:
                yield slot.name, len(value)
            if slot.text is not None:
                continue
            for item in value:
                if slot.element is None:
                    yield f"{slot.name}[]", item
                else:
                    yield from ((f"{slot.name}.{name}", each) for name, each in item.items())


def _of_number(path: str, slot: Number) -> Values:
    return _of_field(path, slot.field, slot.low, slot.high)


def _of_field(path: str, said: NumberField, low: float, high: float) -> Values:
    named = {name: each.value for name, each in said.values.items()}
    bits = None
    for each in said.bits.values():
        top = each.at.low if each.at.high is None else each.at.high
        bits = (bits or 0) | sum(1 << bit for bit in range(each.at.low, top + 1))
    limits = None if said.limits is None else (said.limits.usual.low, said.limits.usual.high)
    measures = said.unit or said.scale or said.range or said.limits or said.text
    return Values(
        path,
        low,
        high,
        named,
        limits,
        bits,
        is_set=len(named) > 1 and not measures and not said.bits,
    )
