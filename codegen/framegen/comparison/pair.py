"""The pair of editions: who is who in them, settled once for all that compares them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.comparison.pairing import Pairing, paired
from framegen.language.values import Direction
from framegen.model.slots import Constant, Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Which
    from framegen.language.spec import NumberField
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.slots import MessageSlot


@dataclass(frozen=True, eq=False)
class Pair:
    """Two editions of one protocol, and which names in the one are which in the other.

    The ends of a line are the same by name, or else by their order; messages, fields, named values
    and bits by what `was` says, by name, or by place.
    """

    old: Edition
    new: Edition

    @property
    def turned(self) -> Pair:
        """The same editions the other way round."""
        return self._turned

    @cached_property
    def _turned(self) -> Pair:
        return Pair(self.new, self.old)

    def edition(self, which: Which) -> Edition:
        """Return one of the two."""
        return self.old if which == "old" else self.new

    @cached_property
    def ends(self) -> Mapping[str, str]:
        """The ends of the old edition, each with its name in the new one."""
        old, new = [*self.old.spec.endpoints], [*self.new.spec.endpoints]
        found = {name: name for name in old if name in new}
        for name, other in zip(old, new, strict=False):
            if name not in found and other not in old:
                found[name] = other
        return found

    def way_in_new(self, way: Direction) -> Direction | None:
        """Return a direction of the old edition as the new one calls it; None without an end."""
        return _way(way, self.ends)

    def way_in_old(self, way: Direction) -> Direction | None:
        """Return a direction of the new edition as the old one calls it; None without an end."""
        return _way(way, {new: old for old, new in self.ends.items()})

    @cached_property
    def frames(self) -> Pairing:
        """The kinds of frames: one that is the only one in both editions is the same."""
        old, new = self.old.model.envelopes, self.new.model.envelopes
        if len(old) == len(new) == 1:
            return Pairing(dict(zip(old, new, strict=True)), frozenset(), (), ())
        found = paired(
            {name: _parts(each) for name, each in old.items()},
            {name: _parts(each) for name, each in new.items()},
            {},
        )
        # Nobody sees the name of a kind of frame, so nothing depends on it.
        return Pairing(found.to_new, frozenset(), found.removed, found.added)

    @cached_property
    def messages(self) -> Pairing:
        """The messages: under a name that was changed, ids, direction and fields are the same."""
        old, new = self.old.model.messages, self.new.model.messages
        alone = len(self.old.model.envelopes) == len(self.new.model.envelopes) == 1
        was, old_was = (
            {name: layout.message.was for name, layout in each.items()} for each in (new, old)
        )
        return paired(
            {
                name: _identity(each, self.way_in_new(each.direction), alone)
                for name, each in old.items()
            },
            {name: _identity(each, each.direction, alone) for name, each in new.items()},
            was,
            old_was,
        )

    def fields(self, old: MessageLayout, new: MessageLayout) -> Pairing:
        """Pair the fields of two messages, constants and counts among them, and what frames add."""
        key = old.name, new.name
        if key not in self._fields:
            self._fields[key] = _fields(old, new)
        return self._fields[key]

    @cached_property
    def _fields(self) -> dict[tuple[str, str], Pairing]:
        """The pairings of fields that were asked for, by the names of their messages."""
        return {}


def element_fields(old: Items, new: Items) -> Pairing:
    """Pair the fields of the elements of two lists."""
    if old.element is None or new.element is None:
        same = {old.slots[0].name: new.slots[0].name} if old.element == new.element else {}
        return Pairing(same, frozenset(), (), ())
    return _paired_slots(old.slots, new.slots, 0, 0)


def named_values(old: NumberField, new: NumberField) -> Pairing:
    """Pair the named values of two numbers."""
    return paired(
        {name: each.value for name, each in old.values.items()},
        {name: each.value for name, each in new.values.items()},
        {name: each.was for name, each in new.values.items()},
        {name: each.was for name, each in old.values.items()},
    )


def named_bits(old: NumberField, new: NumberField) -> Pairing:
    """Pair the named bits of two numbers."""
    return paired(
        {name: each.at for name, each in old.bits.items()},
        {name: each.at for name, each in new.bits.items()},
        {name: each.was for name, each in new.bits.items()},
        {name: each.was for name, each in old.bits.items()},
    )


def shape(slot: MessageSlot, start: int = 0) -> object:
    """Return what can be told of a slot on the wire but for its name: its place and its type.

    The place counts from `start`.
    """
    at = slot.at - start
    match slot:
        case Items():
            return at, "list", tuple(shape(each) for each in slot.slots)
        case Packed():
            return at, "packed", slot.number_type.name, slot.count
        case Text():
            return at, "text", slot.size
        case Constant():
            return at, slot.role, slot.data
        case Number():
            return at, slot.role, slot.number_type.name


def _identity(layout: MessageLayout, way: Direction | None, alone: bool) -> object:
    """Return what can be told of a message but for its name; frames that are `alone` are alike."""
    if way is None:
        return None
    frame = None if alone else _parts(layout.frame)
    start = layout.frame.body_at
    return layout.ids, way, frame, tuple(shape(slot, start) for slot in layout.body)


def _fields(old: MessageLayout, new: MessageLayout) -> Pairing:
    found = _paired_slots(old.body, new.body, old.frame.body_at, new.frame.body_at)
    to_new = dict(found.to_new)
    # There is at most one of these, so that its name does not matter.
    for part in ("address", "counter"):
        one, other = getattr(old.frame, part), getattr(new.frame, part)
        if one is not None and other is not None:
            to_new[one.name] = other.name
    return Pairing(to_new, found.guessed, found.removed, found.added)


def _paired_slots(
    old: Iterable[MessageSlot], new: Iterable[MessageSlot], old_start: int, new_start: int
) -> Pairing:
    old, new = tuple(old), tuple(new)
    was, old_was = (
        {slot.name: slot.field.was for slot in each if slot.field is not None}
        for each in (new, old)
    )
    return paired(
        {slot.name: shape(slot, old_start) for slot in old},
        {slot.name: shape(slot, new_start) for slot in new},
        was,
        old_was,
    )


def _way(way: Direction, ends: Mapping[str, str]) -> Direction | None:
    sender, receiver = ends.get(way.sender), ends.get(way.receiver)
    return None if sender is None or receiver is None else Direction(sender, receiver)


def _parts(frame: Envelope) -> object:
    """Return the parts of a kind of frame without their names."""
    places = {slot.name: at for at, slot in enumerate(frame.slots)}
    return tuple(
        (
            slot.role,
            getattr(slot, "data", None),
            slot.number_type.name if isinstance(slot, Number) else None,
            getattr(slot, "order", None),
            getattr(slot, "method", None),
            tuple(places.get(name) for name in getattr(slot, "of", ())),
        )
        for slot in (*frame.slots, *frame.unsent)
    )
