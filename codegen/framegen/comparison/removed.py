"""Removed messages: their ids and names, which must not be given to another one by accident."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.comparison.entry import sentence

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.comparison import Comparison
    from framegen.language.notation import Ids
    from framegen.language.spec import Spec
    from framegen.language.values import Direction


def reservations(comparison: Comparison, reason: str | None) -> Iterator[dict[str, Any]]:
    """Yield entries for `reserved`: what was removed, and is not reserved yet.

    Each says why, as the history accepts it, or else for the `reason` that is given.

    What only seems to have another name counts: `was` would say so. An id that has another message
    already is left out, and so is one whose ends are gone.
    """
    new, pairing = comparison.new.spec, comparison.pair.messages
    for name in (*pairing.removed, *sorted(pairing.guessed)):
        message = comparison.old.spec.messages[name]
        way = comparison.pair.way_in_new(message.direction)
        entry: dict[str, Any] = {}
        if message.id is not None and way is not None and _is_free_id(new, message.id, way):
            entry |= {"id": _as_written(message.id), "direction": str(way)}
        if name not in new.messages and all(each.name != name for each in new.reserved):
            entry["name"] = name
        if entry:
            entry["why"] = _why(comparison, name, reason)
            yield entry


def _why(comparison: Comparison, name: str, reason: str | None) -> str:
    said = (
        effect.accepted
        for effect in comparison.effects
        if effect.accepted and effect.old == ("messages", name)
    )
    why = next(said, reason)
    what = f"Up to {comparison.old.version} it was {name}"
    return f"{what}: {sentence(why)}" if why and why.strip() else f"{what}."


def _is_free_id(spec: Spec, ids: Ids, way: Direction) -> bool:
    used = any(each.id == ids and each.direction == way for each in spec.messages.values())
    return not used and not any(
        each.id == ids and each.direction in (None, way) for each in spec.reserved
    )


def _as_written(ids: Ids) -> int | dict[str, int]:
    return dict(ids.by_part) if ids.one is None else ids.one
