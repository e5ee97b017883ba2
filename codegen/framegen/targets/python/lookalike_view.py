"""The look-alikes as the templates show them: the places of their frames' slots."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Body, Constant, Number
from framegen.targets.python.checksum_view import ChecksumView
from framegen.targets.python.escape import Bracketed, Part, Text, byte_literal, literal

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.language.spec import Lookalike
    from framegen.model.envelope import Envelope
    from framegen.model.slots import ByteOrder

_Place = tuple[int, int]
# What a library works out without any method.
_USUAL = "inverted sum"


@dataclass(frozen=True, slots=True)
class LookalikeView:
    """A look-alike, the envelope of its frames, and the byte order of the protocol."""

    lookalike: Lookalike
    frame: Envelope
    order: ByteOrder

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
        if self.methods:
            made = [method.made for method in self.methods]
            described.append(Bracketed("methods=(", [*made], ")", lone=","))
        items = [Text(self.lookalike.title), literal(self.order), *described]
        return Bracketed("Lookalike(", items, ")")

    @property
    def _constants(self) -> list[Bracketed]:
        return [
            Bracketed("(", [self._slice(slot), byte_literal(slot.data)], ")")
            for slot in self.frame.slots
            if isinstance(slot, Constant) and slot.role == "constant"
        ]

    @property
    def _checksums(self) -> list[Bracketed]:
        return [
            Bracketed("(", [self._slice(slot), self._covered(slot)], ")") for slot in self._proofs
        ]

    @property
    def methods(self) -> list[ChecksumView]:
        """What works out its checksums; nothing where these are inverted sums."""
        made = [ChecksumView(slot.method, 8 * slot.size) for slot in self._proofs]
        return made if any(each.method != _USUAL for each in made) else []

    @property
    def is_recognisable(self) -> bool:
        """Whether its frames can be found, and tell what they are."""
        # With neither a frame nor commands of its own, there is nothing to tell it by.
        own = self.lookalike.frame is not None or bool(self.lookalike.commands)
        parts = self.frame.header and self.frame.length_part and self.frame.id_part
        return own and bool(parts)

    @property
    def _proofs(self) -> list[Number]:
        """The checksums; one over an id that is not sent tells nothing."""
        unsent = {part.name for part in self.frame.unsent}
        found = (slot for slot in self.frame.slots if isinstance(slot, Number))
        return [each for each in found if each.role == "checksum" and not unsent & {*each.of}]

    def _covered(self, checksum: Number) -> Bracketed:
        """Return the places that a checksum is computed from."""
        slots = {slot.name: slot for slot in self.frame.slots}
        places = _joined(self._place(slots[name]) for name in checksum.of)
        return Bracketed("(", [_slice(place) for place in places], ")", lone=",")

    def _slice(self, slot: Constant | Number) -> str:
        """Return the place of a slot; backwards, where the other byte of a number comes first."""
        start, end = self._place(slot)
        if isinstance(slot, Number) and slot.size > 1 and slot.order != self.order:
            # In front of the first byte, or behind the last one from the end.
            return f"slice({end - 1}, {start - 1 if start else None}, -1)"
        return _slice((start, end))

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
