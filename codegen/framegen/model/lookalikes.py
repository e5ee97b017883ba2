"""Recognition of look-alikes: frames of protocols that are easily taken for this one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Constant, Number

if TYPE_CHECKING:
    from framegen.language.spec import Lookalike
    from framegen.model.envelope import Envelope
    from framegen.model.model import Model
    from framegen.model.slots import Placed


@dataclass(frozen=True, slots=True)
class Recognised:
    """A frame of a look-alike: which one, and the places of its parts."""

    name: str
    lookalike: Lookalike
    parts: tuple[Placed, ...]
    command: int

    @property
    def meaning(self) -> str:
        """The meaning of the id there; empty where the spec does not say."""
        return self.lookalike.commands.get(self.command, "")


def recognise(model: Model, data: bytes) -> Recognised | None:
    """Find the look-alike of which `data` is exactly one frame."""
    for name, lookalike in model.spec.lookalikes.items():
        frame = model.lookalikes[name]
        parts = _parts(frame, data)
        # With neither a frame nor codes of its own, there is nothing to tell it by.
        if parts is None or not (lookalike.frame or lookalike.commands):
            continue
        command = frame.id.read(parts[frame.id.name].of(data))
        if command in lookalike.commands or not lookalike.commands:
            return Recognised(name, lookalike, tuple(parts.values()), command)
    return None


def _parts(frame: Envelope, data: bytes) -> dict[str, Placed] | None:
    """Cut `data` into the parts of `frame`; None where a part shows that it is no such frame."""
    if len(data) < frame.least:
        return None
    parts = {placed.path: placed for placed in frame.lay_out(len(data))}
    return parts if all(_fits(placed, parts, data) for placed in parts.values()) else None


def _fits(placed: Placed, parts: dict[str, Placed], data: bytes) -> bool:
    slot, found = placed.slot, placed.of(data)
    if isinstance(slot, Constant):
        return found == slot.data
    if not isinstance(slot, Number):
        return True
    match slot.role:
        case "length":
            return slot.read(found) == sum(parts[name].size for name in slot.of)
        case "checksum":
            total = sum(sum(parts[name].of(data)) for name in slot.of)
            return slot.read(found) == ~total & slot.number_type.high
        case _:
            return True
