"""Dropped reservations: ids and names that the old edition reserves, and the new one sets free."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.wording import reservation
from framegen.comparison.effect import Effect

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.effect import Axis
    from framegen.comparison.pair import Pair
    from framegen.language.spec import Reserved
    from framegen.language.values import Direction
    from framegen.reading.yamltree import KeyPath


def unreserved_effects(pair: Pair) -> Iterator[Effect]:
    """Yield an effect for each id and each name that `framegen check` would not refuse any more.

    Nothing is misread yet, but nobody would notice the message that takes it. One that a message
    has is no longer free: what that breaks is looked for elsewhere.
    """
    for number, reserved in enumerate(pair.old.spec.reserved):
        old = ("reserved", number)
        if reserved.id is not None and not _holds_id(pair, reserved):
            what = reservation(reserved.model_copy(update={"name": None}))
            yield _dropped(old, "wire", what, reserved.why, reserved.direction)
        if reserved.name is not None and not _holds_name(pair, reserved.name):
            yield _dropped(old, "programs", f"name {reserved.name}", reserved.why)


def _dropped(old: KeyPath, axis: Axis, what: str, why: str, way: Direction | None = None) -> Effect:
    text = f"the {what} is not reserved any more, and its reason was: {why}"
    ends = "" if way is None else f"new {way.sender}, old {way.receiver}"
    return Effect(axis, "uncertain", old, None, text, ends, certain=False)


def _holds_id(pair: Pair, reserved: Reserved) -> bool:
    """Tell whether the new edition reserves or has the id, wherever it was reserved."""
    ways = [*pair.new.model.directions]
    if reserved.direction is not None:
        ways = [way for way in ways if way == pair.way_in_new(reserved.direction)]
    spec = pair.new.spec
    kept = [each.direction for each in spec.reserved if each.id == reserved.id]
    used = [each.direction for each in spec.messages.values() if each.id == reserved.id]
    return None in kept or all(way in kept or way in used for way in ways)


def _holds_name(pair: Pair, name: str) -> bool:
    """Tell whether the new edition reserves the name, or a message has it or had it."""
    spec = pair.new.spec
    return any(each.name == name for each in spec.reserved) or any(
        name in (here, *message.was) for here, message in spec.messages.items()
    )
