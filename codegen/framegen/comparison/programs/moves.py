"""Moves: where what is at a path of the old edition is in the new one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.comparison.pair import element_fields, named_bits, named_values
from framegen.comparison.programs.origins import Origin, frame_path
from framegen.language.spec import NumberField
from framegen.model.slots import Items

if TYPE_CHECKING:
    from framegen.comparison.pair import Pair
    from framegen.comparison.pairing import Pairing
    from framegen.model.envelope import Envelope
    from framegen.model.slots import MessageSlot
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, eq=False)
class Moves:
    """Where each thing of the old edition is in the new one, as the pair of them says."""

    pair: Pair

    def origin(self, origin: Origin) -> Origin | None:
        """Return the origin in the new edition; None where it is gone."""
        path = self._in_frame_of(origin.owner, origin.path) or self.path(origin.path)
        owner = self.path(origin.owner)
        return None if path is None or owner is None else Origin(origin.role, path, owner)

    def _in_frame_of(self, owner: KeyPath, path: KeyPath) -> KeyPath | None:
        """Return where a part of a message's frame is, whichever kind of frame it has now."""
        if path[0] not in ("frame", "frames") or owner[:1] != ("messages",):
            return None
        name = str(owner[1])
        other = self.pair.messages.to_new.get(name)
        if other is None:
            return None
        models = self.pair.old.model, self.pair.new.model
        frames = models[0].messages[name].frame, models[1].messages[other].frame
        rest = path[1:] if path[0] == "frame" else path[2:]
        return self._in_envelope(*frames, rest)

    def path(self, path: KeyPath) -> KeyPath | None:
        """Return the path in the new edition; None where it is gone."""
        match path:
            case ("messages", str(name), *rest):
                return self._in_message(name, tuple(rest))
            case ("endpoints", str(name)):
                end = self.pair.ends.get(name)
                return None if end is None else ("endpoints", end)
            case ("frames", str(frame), *rest):
                return self._in_frame(frame, tuple(rest))
            case ("frame", *rest):
                return self._in_frame(next(iter(self.pair.old.model.envelopes)), tuple(rest))
            case _:
                return path

    def _in_message(self, name: str, rest: KeyPath) -> KeyPath | None:
        other = self.pair.messages.to_new.get(name)
        if other is None:
            return None
        here: KeyPath = ("messages", other)
        if not rest or rest[0] != "fields":
            return (*here, *rest)
        old, new = self.pair.old.model.messages[name], self.pair.new.model.messages[other]
        moved = _moved(self.pair.fields(old, new), old.slots, new.slots, rest[1:])
        return None if moved is None else (*here, "fields", *moved)

    def _in_frame(self, name: str, rest: KeyPath) -> KeyPath | None:
        models = self.pair.old.model, self.pair.new.model
        other = self.pair.frames.to_new.get(name)
        if other is None:
            return None
        if not rest:
            return frame_path(models[1], other)
        return self._in_envelope(models[0].envelopes[name], models[1].envelopes[other], rest)

    def _in_envelope(self, old: Envelope, new: Envelope, rest: KeyPath) -> KeyPath | None:
        here = frame_path(self.pair.new.model, new.name)
        for part in ("address", "counter"):
            one, another = getattr(old, part), getattr(new, part)
            if one is not None and one.name == rest[0] and another is not None:
                inside = _inside(one, another, rest[1:])
                return None if inside is None else (*here, another.name, *inside)
        return None


def _moved(
    pairing: Pairing,
    ours: tuple[MessageSlot, ...],
    theirs: tuple[MessageSlot, ...],
    path: KeyPath,
) -> KeyPath | None:
    name, *rest = path
    other = pairing.to_new.get(str(name))
    if other is None:
        return None
    old = next(slot for slot in ours if slot.name == name)
    new = next(slot for slot in theirs if slot.name == other)
    inside = _inside(old, new, tuple(rest))
    return None if inside is None else (other, *inside)


def _inside(old: MessageSlot, new: MessageSlot, path: KeyPath) -> KeyPath | None:
    """Return a path below a field: to a named value, to bits, or to a field of an element."""
    if not path:
        return ()
    if path[0] == "fields" and isinstance(old, Items) and isinstance(new, Items):
        moved = _moved(element_fields(old, new), old.slots, new.slots, path[1:])
        return None if moved is None else ("fields", *moved)
    one, other = old.field, new.field
    if not isinstance(one, NumberField) or not isinstance(other, NumberField):
        return None
    pairing = {"values": named_values, "bits": named_bits}[str(path[0])](one, other)
    name = pairing.to_new.get(str(path[1]))
    return None if name is None else (path[0], name)
