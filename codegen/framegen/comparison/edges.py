"""The values at which the frames of a message are tried out: the edges of both editions.

For each argument, the lowest and the highest value, those with a name, those next to the ends of
the other edition's range, and one whose bytes are all different, so that their order shows. One
argument is varied at a time, then two; what is not varied keeps a value that both editions allow.
"""

from __future__ import annotations

from itertools import chain, combinations, islice, product
from typing import TYPE_CHECKING, Any

from framegen.comparison.meaning import always_of
from framegen.comparison.pair import element_fields
from framegen.model.slots import Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.model.layout import MessageLayout
    from framegen.model.slots import Field

# So many frames of a message are tried out at most.
MOST = 2000
# Of a list, so many elements unless its ends are looked at.
_FEW = 3
# A longer frame is tried out only for the ends of a list.
_SHORT = 0x1000
_FLOATS = (0.0, 1.0, -0.1, 1e-3, 123456.75, 3e38)


def values_to_try(
    message: MessageLayout, other: MessageLayout | None, names: Mapping[str, str], *, pairs: bool
) -> Iterator[dict[str, Any]]:
    """Yield values of a message, at most `MOST`; `names` are those of its arguments in `other`.

    With `pairs`, two arguments at a time are varied too.
    """
    edges = Edges(message, other, names)
    yield from islice(chain(edges.single(), edges.pairs() if pairs else ()), MOST)


class Edges:
    """The values of one message that are tried; `names` are those of its arguments in `other`."""

    def __init__(
        self, message: MessageLayout, other: MessageLayout | None, names: Mapping[str, str]
    ) -> None:
        theirs = {} if other is None else {slot.name: slot for slot in other.arguments}
        always = {} if other is None else dict(always_of(other.body))
        self._message = message
        self._slots = {slot.name: slot for slot in message.arguments}
        self._edges = {
            name: _edges(slot, theirs.get(names.get(name, "")), at)
            for at, (name, slot) in enumerate(self._slots.items())
        }
        for name, slot in self._slots.items():
            value = always.get(names.get(name, ""))
            if value is not None and isinstance(slot, Number) and slot.holds(value):
                # What is free now is understood where it is as it always was.
                self._edges[name].append(value)
        self._counts = _counts(message, other)
        # The usual elements of lists.
        self._elements = {
            name: _element_edges(slot, None)[0]
            for name, slot in self._slots.items()
            if isinstance(slot, Items)
        }

    def single(self) -> Iterator[dict[str, Any]]:
        """Yield values of which one is varied at a time, and each count."""
        for count in self._counts:
            yield self._filled(count, {})
        yield from self._varied(
            {name: value} for name, each in self._edges.items() for value in each
        )

    def pairs(self) -> Iterator[dict[str, Any]]:
        """Yield values of which two are varied at a time."""
        yield from self._varied(
            {one: first, other: second}
            for one, other in combinations(self._edges, 2)
            for first, second in product(self._edges[one], self._edges[other])
        )

    def _varied(self, several: Iterable[dict[str, Any]]) -> Iterator[dict[str, Any]]:
        usual = next(
            (count for count in self._counts if _is_usual(self._message, count)), self._counts[0]
        )
        # Where it may be absent, every size shows what is there.
        others = [count for count in self._counts if count != usual and self._message.optional]
        for given in several:
            for count in (usual, *others):
                yield self._filled(count, given)

    def _filled(self, count: int, given: dict[str, Any]) -> dict[str, Any]:
        """Return every argument: as given, or as usual; None for what so short a frame has not."""
        there = {slot.name for slot in self._message.there(count)}
        return {
            name: self._whole(slot, given.get(name, self._edges[name][0]), count, name in given)
            if name in there
            else None
            for name, slot in self._slots.items()
        }

    def _whole(self, slot: Field, value: Any, count: int, varied: bool) -> Any:
        """Return the value of an argument; of a list, so many elements, one of which it is."""
        match slot:
            case Items():
                number = slot.low if slot.is_fixed else count
                items = [self._elements[slot.name]] * number
                if number:
                    items[-1 if varied else 0] = value
                return items if slot.text is None else "".join(map(chr, items))
            case Packed():
                usual = max(slot.low, min(1, slot.high))
                numbers = [usual] * slot.count
                numbers[-1 if varied else 0] = value
                return numbers
            case _:
                return value


def _is_usual(message: MessageLayout, count: int) -> bool:
    if message.items is None:
        return not message.optional or count == message.counts[-1]
    return count >= min(_FEW, message.counts[-1]) and message.size_at(count) <= _SHORT


def _counts(message: MessageLayout, other: MessageLayout | None) -> list[int]:
    """Return the counts that are tried: few, then the ends of both editions, and next to them."""
    possible = message.counts
    if message.optional:
        return [*reversed(possible)]
    wanted = [min(possible[-1], max(possible[0], _FEW)), possible[0], possible[-1]]
    wanted += [possible[0] + 1, possible[0] + 2, 0x100]
    if other is not None and not other.optional:
        for end in (other.counts[0], other.counts[-1]):
            wanted += [end - 1, end, end + 1]
    return [count for count in dict.fromkeys(wanted) if count in possible]


def _edges(slot: Field, other: Field | None, at: int) -> list[Any]:
    match slot:
        case Items():
            return _element_edges(slot, other)
        case Packed():
            theirs = (other.low, other.high) if isinstance(other, Packed) else None
            return _numbers(slot.low, slot.high, slot.size, theirs, at)
        case Text():
            return ["Ab", "", "~" * slot.size, "A" * max(0, slot.size - 1)]
        case Number():
            return _number(slot, other if isinstance(other, Number) else None, at)


def _element_edges(items: Items, other: Field | None) -> list[Any]:
    """Return elements to try: each field of an element at each of its edges."""
    there = {each.name: each for each in other.fields} if isinstance(other, Items) else {}
    names = element_fields(items, other).to_new if isinstance(other, Items) else {}
    edges: dict[str, list[Any]] = {}
    for at, field in enumerate(items.fields):
        theirs = there.get(names.get(field.name, ""))
        if items.element is None and isinstance(other, Items) and other.element is None:
            theirs = other.fields[0]
        edges[field.name] = (
            _number(field, theirs if isinstance(theirs, Number) else None, at)
            if isinstance(field, Number)
            else ["Ab"[: field.size], "", "~" * field.size]
        )
    if items.element is None:
        (only,) = edges.values()
        return only
    usual = {name: each[0] for name, each in edges.items()}
    varied = [{**usual, name: value} for name, each in edges.items() for value in each]
    return [usual, *varied]


def _number(slot: Number, other: Number | None, at: int) -> list[Any]:
    if slot.is_float:
        return _floats(slot)
    both = [slot] if other is None or other.is_float else [slot, other]
    named = [value.value for each in both for value in each.field.values.values()]
    bits = [bits.at for each in both for bits in each.field.bits.values()]
    ones = [1 << bit for at_ in bits for bit in (at_.low, at_.high or at_.low)]
    theirs = (other.low, other.high) if len(both) > 1 and other is not None else None
    wanted = [*_numbers(slot.low, slot.high, slot.size, theirs, at), *named, *ones]
    return [value for value in dict.fromkeys(wanted) if slot.holds(value)]


def _floats(slot: Number) -> list[Any]:
    found: list[Any] = []
    for value in _FLOATS:
        try:
            found.append(slot.value(slot.write(value)))
        except OverflowError:
            continue
    return found


def _numbers(low: int, high: int, size: int, theirs: tuple[int, int] | None, at: int) -> list[int]:
    """Return numbers to try, first the one that is usual: small, allowed by both, and its own."""
    least, most = (low, high) if theirs is None else (max(low, theirs[0]), min(high, theirs[1]))
    usual = min(least + at + 1, most) if least <= most else low
    telltale = int.from_bytes(bytes(range(1, size + 1)), "big")
    wanted = [usual, low, high, low + 1, high - 1, telltale]
    wanted += [each + step for each in theirs or () for step in (0, -1, 1)]
    return [value for value in dict.fromkeys(wanted) if low <= value <= high]
