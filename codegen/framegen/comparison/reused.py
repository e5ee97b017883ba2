"""Reuse: ids and names that the old edition reserves, and the new one gives to a message."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.effect import Effect

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.comparison.pair import Pair
    from framegen.language.spec import Message, Reserved


def reuse_effects(pair: Pair) -> Iterator[Effect]:
    """Yield an effect for each id and each name that is used again.

    Neither edition can show what it meant before, so that it is uncertain.
    """
    for number, reserved in enumerate(pair.old.spec.reserved):
        old = ("reserved", number)
        for name, message in pair.new.spec.messages.items():
            if reserved.name in (name, *message.was) and _has_id(pair, reserved, message):
                # It is back.
                continue
            before = pair.messages.to_old.get(name)
            known = None if before is None else pair.old.spec.messages[before]
            new, why = ("messages", name), f"it was reserved: {reserved.why}"
            if _has_id(pair, reserved, message) and (known is None or known.id != message.id):
                what = "as something else" if reserved.name is None else f"as {reserved.name}"
                text = f"{name}: ends in use may still know the id {message.id} {what}; {why}"
                way = pair.way_in_old(message.direction) or message.direction
                ends = f"new {message.direction.sender}, old {way.receiver}"
                remedy = f"Give {name} another id, and keep what is reserved."
                yield Effect(
                    "wire", "uncertain", old, new, text, ends, certain=False, remedy=remedy
                )
            if reserved.name == name and name not in pair.old.spec.messages:
                text = f"{name}: programs in use may still know another message of that name; {why}"
                remedy = f"Give {name} another name, and keep what is reserved."
                yield Effect("programs", "uncertain", old, new, text, certain=False, remedy=remedy)


def without_shown(effects: Sequence[Effect]) -> list[Effect]:
    """Return effects without the uncertain ones of which others show a frame."""
    shown = {(each.axis, each.new) for each in effects if each.witness is not None}
    return [each for each in effects if each.witness or (each.axis, each.new) not in shown]


def _has_id(pair: Pair, reserved: Reserved, message: Message) -> bool:
    """Tell whether a message of the new edition has the id that is reserved in the old one."""
    if reserved.id is None or reserved.id != message.id:
        return False
    return reserved.direction in (None, pair.way_in_old(message.direction))
