"""The look-alikes as the templates show them: the places of their frames' slots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Body, Constant, Number
from framegen.targets.python.escape import Bracketed, Part, Text, byte_literal

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.language.spec import Lookalike
    from framegen.model.envelope import Envelope

_Place = tuple[int, int]


@dataclass(frozen=True, slots=True)
class LookalikeView:
    """A look-alike, and the envelope of its frames."""

    lookalike: Lookalike
    frame: Envelope

    @property
    def entry(self) -> Bracketed:
        """The call that describes it."""
        commands = [str(code) for code in sorted(self.lookalike.commands)]
        described: list[Part] = [
            Bracketed("constants=(", self._constants, ")", lone=","),
            f"length={self._slice(self.frame.length)}",
            f"uncounted={self.frame.uncounted}",
            f"least={self.frame.least}",
            f"command={self._slice(self.frame.id)}",
            Bracketed("commands=(", commands, ")", lone=","),
            Bracketed("checksums=(", self._checksums, ")", lone=","),
        ]
        items = [Text(self.lookalike.title), *described]
        return Bracketed("Lookalike(", items, ")")

    @property
    def _constants(self) -> list[Bracketed]:
        return [
            Bracketed("(", [self._slice(slot), byte_literal(slot.data)], ")")
            for slot in self.frame.slots
            if isinstance(slot, Constant)
        ]

    @property
    def _checksums(self) -> list[Bracketed]:
        return [
            Bracketed("(", [self._slice(slot), self._covered(slot)], ")")
            for slot in self.frame.slots
            if isinstance(slot, Number) and slot.role == "checksum"
        ]

    def _covered(self, checksum: Number) -> Bracketed:
        """Return the places that a checksum is computed from."""
        slots = {slot.name: slot for slot in self.frame.slots}
        places = _joined(self._place(slots[name]) for name in checksum.of)
        return Bracketed("(", [_slice(place) for place in places], ")", lone=",")

    def _slice(self, slot: Constant | Number | Body) -> str:
        return _slice(self._place(slot))

    def _place(self, slot: Constant | Number | Body) -> _Place:
        """Return where a slot begins and ends: from the front, or behind the body from the end."""
        if isinstance(slot, Body):
            return slot.at, -sum(each.size for each in self.frame.tail)
        return slot.at, slot.at + slot.size


def _joined(places: Iterable[_Place]) -> list[_Place]:
    """Join places that follow each other."""
    joined: list[_Place] = []
    for start, end in places:
        if joined and joined[-1][1] == start != 0:
            joined[-1] = (joined[-1][0], end)
        else:
            joined.append((start, end))
    return joined


def _slice(place: _Place) -> str:
    """Return a place as code; 0 for an end is the end of the frame."""
    start, end = place
    return f"slice({start}, {end or None})"
