"""What values mean to the two ends: compared in their units, and by the names that they have."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framegen.comparison.pair import element_fields, named_bits, named_values
from framegen.comparison.units import is_known, quantity
from framegen.model.slots import Constant, Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.comparison.effect import Outcome
    from framegen.comparison.pairing import Pairing
    from framegen.language.spec import Bits, NumberField
    from framegen.model.layout import MessageLayout
    from framegen.model.slots import Field, MessageSlot

End: TypeAlias = Literal["sender", "receiver"]


@dataclass(frozen=True, slots=True)
class Difference:
    """A value that the receiver does not read as the sender means it.

    Of what is only understood `in part`, `known_to` says which end knows of the value.
    """

    outcome: Outcome
    path: str
    text: str
    known_to: End | None = None


def differences(
    pairing: Pairing,
    sender: MessageLayout,
    receiver: MessageLayout,
    sent: Mapping[str, Any],
    read: Mapping[str, Any],
) -> Iterator[Difference]:
    """Compare the values of a message as sent with those read.

    `pairing` is that of the fields, from the sender to the receiver. What is absent on both ends is
    nothing.
    """
    yield from _of_slots(pairing, _Said.by(sender, sent), _Said.by(receiver, read), "")


def translated(
    pairing: Pairing, ours: MessageLayout, theirs: MessageLayout, values: Mapping[str, Any]
) -> dict[str, Any] | None:
    """Return what the other edition would send to say the same; None where it cannot.

    What only the other edition knows is whatever it allows. What it does not know is left out, if
    it had to be sent; it cannot say what its sender chose to add.
    """
    said = {slot.name: _anything(slot) for slot in theirs.arguments}
    named = {slot.name: slot for slot in theirs.arguments}
    always = dict(always_of(theirs.body))
    for slot in ours.arguments:
        called = pairing.to_new.get(slot.name, "")
        value, other = values[slot.name], named.get(called)
        if called in always and always[called] != value:
            return None
        if other is None:
            if value is not None and isinstance(slot, Number) and slot.optional:
                return None
            continue
        again = _again(slot, other, value)
        if again is None and value is not None:
            return None
        said[other.name] = again
    return said


def _again(ours: Field, theirs: Field, value: Any) -> Any:
    """Return a value as the other edition says it; None where it cannot."""
    match ours, theirs:
        case Number(), Number() if value is not None:
            return _same_quantity(ours.field, theirs.field, value)
        case Items(), Items() if ours.element is not None and theirs.element is not None:
            items = [_again_element(ours, theirs, item) for item in value]
            return None if None in items else items
        case Packed() | Items(), Packed() | Items() if _is_bare(ours) and _is_bare(theirs):
            return _numbers_again(_bare_field(ours), _bare_field(theirs), value)
        case Items(), Items():
            one, other = _only(ours), _only(theirs)
            if isinstance(value, str) or one is None or other is None:
                return value
            numbers = _numbers_again(one.field, other.field, _numbers_of(ours, value))
            return None if numbers is None else _with_names(theirs, numbers)
        case _:
            return value


def _numbers_again(
    ours: NumberField, theirs: NumberField, numbers: list[Any]
) -> list[float] | None:
    again = [_same_quantity(ours, theirs, each) for each in numbers]
    said = [each for each in again if each is not None]
    return said if len(said) == len(again) else None


def _with_names(items: Items, numbers: list[Any]) -> list[Any]:
    """Return the elements that numbers are, of a list whose elements have one each."""
    if items.element is None:
        return numbers
    (slot,) = items.fields
    return [{slot.name: each} for each in numbers]


def _again_element(ours: Items, theirs: Items, item: Mapping[str, Any]) -> dict[str, Any] | None:
    names = element_fields(ours, theirs).to_new
    there = {slot.name: slot for slot in theirs.fields}
    said = {name: _anything(slot) for name, slot in there.items()}
    for slot in ours.fields:
        other = there.get(names.get(slot.name, ""))
        if other is not None:
            said[other.name] = _again(slot, other, item[slot.name])
    return None if None in said.values() else said


def _same_quantity(ours: NumberField, theirs: NumberField, number: float) -> float | None:
    """Return the number that means the same in the other edition; None where none does."""
    means, meant = quantity(ours), quantity(theirs)
    if means is None or meant is None or means == meant or means.unit != meant.unit:
        return number
    if not _finite(number):
        return number
    again = meant.raw(means.value(number))
    if theirs.type.startswith("f"):
        return float(again)
    return int(again) if again.denominator == 1 else None


def _anything(slot: Field) -> Any:
    """Return some value of an argument; None for one that may be absent."""
    match slot:
        case Number():
            return None if slot.optional else 0.0 if slot.is_float else slot.low
        case Text():
            return ""
        case Packed():
            return [slot.low] * slot.count
        case Items():
            if slot.text is not None:
                return " " * slot.low
            item = {field.name: _anything(field) for field in slot.fields}
            return [item if slot.element is not None else next(iter(item.values()))] * slot.low


def _bare_field(slot: Packed | Items) -> NumberField:
    """Return what a spec says of the numbers of a list."""
    return slot.field if isinstance(slot, Packed) else slot.fields[0].field


@dataclass(frozen=True, slots=True)
class _Said:
    """What one end says, or reads: the values of its arguments, and what follows from them.

    `derived` are the counts, sizes and constants, which nobody gives and both ends know.
    """

    slots: Mapping[str, Field]
    values: Mapping[str, Any]
    derived: Mapping[str, float]

    @classmethod
    def by(cls, layout: MessageLayout, values: Mapping[str, Any]) -> _Said:
        """Return what a message says."""
        arguments = {slot.name: slot for slot in layout.arguments}
        return cls(arguments, values, dict(_derived(layout.body, values)))

    @classmethod
    def of_element(cls, items: Items, values: Mapping[str, Any]) -> _Said:
        """Return what an element of a list says."""
        fields = {slot.name: slot for slot in items.fields}
        return cls(fields, values, dict(_derived(items.slots, values)))


def _derived(
    slots: Iterable[MessageSlot], values: Mapping[str, Any]
) -> Iterator[tuple[str, float]]:
    for slot in slots:
        match slot:
            case Items():
                for counter in slot.counters:
                    yield counter.name, slot.counted(counter, len(values[slot.name]))
            case Constant():
                yield from always_of([slot])


def always_of(slots: Iterable[MessageSlot]) -> Iterator[tuple[str, float]]:
    """Yield the values that never change, by name."""
    for slot in slots:
        if isinstance(slot, Constant) and slot.field is not None and slot.field.always is not None:
            yield slot.name, slot.field.always


def _of_slots(pairing: Pairing, ours: _Said, theirs: _Said, around: str) -> Iterator[Difference]:
    met: set[str] = set()
    for name, slot in ours.slots.items():
        path, value = f"{around}{name}", ours.values[name]
        called = pairing.to_new.get(name, "")
        other = theirs.slots.get(called)
        if other is not None:
            met.add(called)
            yield from _values(slot, other, value, theirs.values[called], path)
            if name in pairing.guessed:
                text = f"{path} is read as {called}, which may be another thing"
                yield Difference("uncertain", path, text)
        elif called in theirs.derived:
            yield from _same(path, value, theirs.derived[called])
        elif value is not None:
            yield Difference("in part", path, f"{path} is not read", "sender")
    for name, value in theirs.values.items():
        path, called = f"{around}{name}", pairing.to_old.get(name, "")
        if name in met:
            continue
        if called in ours.derived:
            yield from _same(path, ours.derived[called], value)
        elif value is not None:
            yield Difference("in part", path, f"{path} is read, and not sent", "receiver")


def _same(path: str, sent: Any, read: Any) -> Iterator[Difference]:
    """Compare a value with one that follows from the rest of the frame at the other end."""
    if sent != read:
        yield Difference("misread", path, f"{path} = {sent} is read as {read}")


def _values(ours: Field, theirs: Field, sent: Any, read: Any, path: str) -> Iterator[Difference]:
    match ours, theirs:
        case Items(), Items() if ours.text is None and theirs.text is None:
            yield from _lists(ours, theirs, sent, read, path)
        case Number(), Number() if sent is not None and read is not None:
            yield from _numbers(ours.field, theirs.field, sent, read, path)
        case Packed() | Items(), Packed() | Items() if _is_bare(ours) and _is_bare(theirs):
            yield from _bare(_bare_field(ours), _bare_field(theirs), sent, read, path)
        case _:
            if _plain(sent) != _plain(read):
                yield Difference("misread", path, f"{path} = {sent!r} is read as {read!r}")


def _is_bare(slot: Field) -> bool:
    return isinstance(slot, Packed) or (
        isinstance(slot, Items) and slot.element is None and slot.text is None
    )


def _plain(value: Any) -> Any:
    """Return text as the bytes that it is, so that it equals a list of them."""
    if isinstance(value, str):
        return list(value.encode().rstrip(b"\0"))
    if isinstance(value, list) and all(isinstance(each, int) for each in value):
        while value and not value[-1]:
            value = value[:-1]
    return value


def _bare(
    ours: NumberField, theirs: NumberField, sent: list[Any], read: list[Any], path: str
) -> Iterator[Difference]:
    if len(sent) != len(read):
        yield Difference(
            "misread", path, f"{path} has {len(sent)} elements and is read as {len(read)}"
        )
        return
    for index, (one, other) in enumerate(zip(sent, read, strict=True)):
        yield from _numbers(ours, theirs, one, other, f"{path}[{index}]")


def _lists(
    ours: Items, theirs: Items, sent: list[Any], read: list[Any], path: str
) -> Iterator[Difference]:
    if ours.element is None or theirs.element is None:
        one, other = _only(ours), _only(theirs)
        if one is None or other is None:
            yield Difference("misread", path, f"{path} has other elements")
            return
        numbers = _numbers_of(ours, sent), _numbers_of(theirs, read)
        yield from _bare(one.field, other.field, *numbers, path)
        return
    if len(sent) != len(read):
        yield Difference(
            "misread", path, f"{path} has {len(sent)} elements and is read as {len(read)}"
        )
        return
    pairing = element_fields(ours, theirs)
    for index, (one, other) in enumerate(zip(sent, read, strict=True)):
        said, heard = _Said.of_element(ours, one), _Said.of_element(theirs, other)
        yield from _of_slots(pairing, said, heard, f"{path}[{index}].")


def _only(items: Items) -> Number | None:
    """Return the number that each element is, whether it has a name or not; None for others."""
    alone = len(items.slots) == 1 and items.fields and isinstance(items.fields[0], Number)
    return items.fields[0] if alone and isinstance(items.fields[0], Number) else None


def _numbers_of(items: Items, values: list[Any]) -> list[Any]:
    """Return the numbers of a list whose elements have one each."""
    return values if items.element is None else [next(iter(each.values())) for each in values]


def _numbers(
    ours: NumberField, theirs: NumberField, sent: float, read: float, path: str
) -> Iterator[Difference]:
    """Compare two numbers in their units, then by their names and their bits."""
    means, meant = quantity(ours), quantity(theirs)
    if means is not None and meant is not None and _finite(sent) and _finite(read):
        alike = (means.step, means.offset) == (meant.step, meant.offset)
        if means.unit != meant.unit:
            # A name for a unit may be another name for the same, unless both are known.
            known = is_known(means.unit) and is_known(meant.unit)
            outcome: Outcome = "uncertain"
            text = f"{path} = {_said(ours, sent)} is read as {_said(theirs, read)}"
            if known or not alike or sent != read:
                outcome = "misread"
            else:
                text += ", which may be another unit"
            yield Difference(outcome, path, text)
        elif means.value(sent) != meant.value(read):
            text = f"{path} = {_said(ours, sent)} is read as {_said(theirs, read)}"
            yield Difference("misread", path, text)
    elif sent != read and not (math.isnan(sent) and math.isnan(read)):
        yield Difference("misread", path, f"{path} = {sent} is read as {read}")
    yield from _names(ours, theirs, sent, read, path)
    yield from _bits(ours, theirs, sent, read, path)


def _names(
    ours: NumberField, theirs: NumberField, sent: float, read: float, path: str
) -> Iterator[Difference]:
    """Compare the names of two numbers: one that only one end has is a matter of documentation."""
    if not ours.values or not theirs.values:
        return
    pairing = named_values(ours, theirs)
    said = [name for name, each in ours.values.items() if each.value == sent]
    heard = [name for name, each in theirs.values.items() if each.value == read]
    for name in said:
        other = pairing.to_new.get(name)
        if other is not None and other not in heard:
            yield Difference("misread", path, f"{path} = {name} is read as {_called(heard, read)}")
        elif other is not None and name in pairing.guessed:
            text = f"{path} = {name} is read as {other}, which may be another thing"
            yield Difference("uncertain", path, text)
    for name in heard:
        other = pairing.to_old.get(name)
        if other is not None and other not in said:
            yield Difference("misread", path, f"{path} = {_called(said, sent)} is read as {name}")


def _bits(
    ours: NumberField, theirs: NumberField, sent: float, read: float, path: str
) -> Iterator[Difference]:
    if not ours.bits or not theirs.bits or sent != int(sent) or read != int(read):
        return
    pairing = named_bits(ours, theirs)
    for name, other in pairing.to_new.items():
        one, another = _bits_of(ours.bits[name], int(sent)), _bits_of(theirs.bits[other], int(read))
        if one != another:
            text = f"{path}.{name} = {one} is read as {another}"
            yield Difference("misread", path, text)
        elif name in pairing.guessed:
            text = f"{path}.{name} is read as {other}, which may be another thing"
            yield Difference("uncertain", path, text)


def _bits_of(bits: Bits, number: int) -> int:
    low, high = bits.at.low, bits.at.high
    width = 1 if high is None else high - low + 1
    return number >> low & (1 << width) - 1


def _called(names: list[str], number: float) -> str:
    return names[0] if names else str(number)


def _said(field: NumberField, number: float) -> str:
    """Return a number with its unit, as people write it."""
    if field.scale is None:
        return f"{number} {field.unit}".rstrip()
    said = field.scale.step * int(number) + field.scale.offset if number == int(number) else number
    return f"{said} {field.scale.unit}".rstrip()


def _finite(number: float) -> bool:
    return math.isfinite(number)
