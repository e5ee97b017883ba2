"""An envelope as the templates show it: its parts, with what a checksum covers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import groupby
from typing import TYPE_CHECKING

from framegen.model.slots import Constant
from framegen.targets.python.checksum_view import ChecksumView
from framegen.targets.python.escape import Bracketed, byte_literal, literal
from framegen.targets.python.names import envelope_name

if TYPE_CHECKING:
    from framegen.model.envelope import Envelope
    from framegen.model.slots import Number
    from framegen.targets.python.escape import Part


@dataclass(frozen=True, slots=True)
class EnvelopeView:
    """The envelope of some messages."""

    frame: Envelope

    @property
    def constant(self) -> str:
        """The name of the constant that is it."""
        return envelope_name(self.frame.name)

    @property
    def assigned(self) -> str:
        """The assignment of that constant."""
        return Bracketed(f"{self.constant} = Envelope(", self._arguments, ")").fitted(0)

    @property
    def _arguments(self) -> list[Part]:
        frame = self.frame
        found: list[Part] = [literal(frame.name)]
        for name, slots in (("head", frame.head), ("tail", frame.tail), ("hidden", frame.unsent)):
            if slots:
                parts = [self._part(slot) for slot in slots]
                found.append(Bracketed(f"{name}=(", parts, ")", lone=","))
        if frame.uncounted:
            found.append(f"uncounted={frame.uncounted}")
        turns = [checksum.name for checksum in frame.checksums]
        if turns != [slot.name for slot in frame.slots if slot.role == "checksum"]:
            found.append(Bracketed("turns=(", [literal(name) for name in turns], ")"))
        return found

    @property
    def parts(self) -> set[str]:
        """The classes of its parts."""
        slots = (*self.frame.head, *self.frame.tail, *self.frame.unsent)
        return {self._kind(slot) for slot in slots}

    def _kind(self, slot: Constant | Number) -> str:
        return slot.role.capitalize()

    def _part(self, slot: Constant | Number) -> Bracketed:
        arguments: list[Part] = [literal(slot.name)]
        if isinstance(slot, Constant):
            is_constant = slot.role == "constant"
            arguments.append(byte_literal(slot.data) if is_constant else str(slot.size))
        else:
            arguments += [str(slot.size), literal(slot.order)]
        if slot.role == "address":
            arguments += self._numbers(slot)
        elif slot.role == "checksum":
            arguments.append(ChecksumView(slot.method, 8 * slot.size).made)
            arguments.append(self._covered(slot))
        return Bracketed(f"{self._kind(slot)}(", arguments, ")")

    def _numbers(self, address: Number) -> list[Part]:
        outside = sorted(each for each in address.named if not address.low <= each <= address.high)
        low = f"{address.low}, " if address.low else ""
        numbers: list[Part] = [f"range({low}{address.high + 1})"]
        if outside:
            numbers.append(Bracketed("(", [str(each) for each in outside], ")", lone=","))
        return numbers

    def _covered(self, checksum: Number) -> Bracketed:
        """Return the stretches that a checksum covers; of an id that is not sent, its number."""
        unsent = [part.name for part in self.frame.unsent]
        pieces: list[Part] = []
        for is_unsent, names in groupby(checksum.of, unsent.__contains__):
            if is_unsent:
                pieces += [str(unsent.index(name)) for name in names]
            else:
                covered = self.frame.covered(replace(checksum, of=tuple(names)), {})
                pieces += [str(piece) for piece in covered.pieces]
        return Bracketed("(", pieces, ")", lone=",")
