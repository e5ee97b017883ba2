"""The parts of a kind of frame, and what there is to say of each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.explain.words import listed

from framegen.model.checksums import CHECKSUMS
from framegen.model.slots import Number
from framegen.targets.docs.notes import NoteView, note_views
from framegen.targets.docs.strip import Cell, parts_strip

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import NamedAddress
    from framegen.model.envelope import Envelope
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class PartView:
    """A part of a frame: its name, what it is, and facts that follow from the spec."""

    name: str
    about: str
    facts: list[str]
    notes: list[NoteView]

    @property
    def text(self) -> str:
        """All of that."""
        return " ".join(filter(None, [self.about, *self.facts]))


@dataclass(frozen=True)
class EnvelopeView:
    """The parts of a kind of frame."""

    model: Model
    name: str

    @property
    def envelope(self) -> Envelope:
        """The envelope in the model."""
        return self.model.envelopes[self.name]

    @property
    def what(self) -> str:
        """Which frames they are, in a sentence."""
        several = len(self.model.envelopes) > 1
        return f"every frame of {self.name}" if several else "every frame"

    @property
    def remarks(self) -> list[str]:
        """What is easily got wrong."""
        frame = self.envelope
        length = frame.length_part
        counted = [] if length is None else [(f"{length.name} counts", length)]
        summed = [(f"{part.name}: {part.method} of", part) for part in frame.checksums]
        place = f" ({self.name})" if len(self.model.envelopes) > 1 else ""
        said = (f"{what} {', '.join(part.of)}{place}." for what, part in [*counted, *summed])
        return [text[:1].upper() + text[1:] for text in said]

    @property
    def cells(self) -> list[Cell]:
        """The parts as a byte strip."""
        return parts_strip(self.model.protocol.envelopes[self.name])

    @property
    def messages(self) -> list[str]:
        """The messages in such frames, where there are several kinds."""
        if len(self.model.envelopes) == 1:
            return []
        return [each.name for each in self.model.messages.values() if each.frame is self.envelope]

    @property
    def parts(self) -> list[PartView]:
        """The parts that there is something to say of."""
        said = self.model.spec.envelopes[self.name]
        slots = {slot.name: slot for slot in (*self.envelope.slots, *self.envelope.unsent)}
        views = [
            PartView(
                name,
                part.about,
                [*self._facts(slots[name])],
                note_views(self.model.spec, part.notes),
            )
            for name, part in said.items()
        ]
        return [view for view in views if view.text or view.notes]

    def _facts(self, slot: object) -> Iterator[str]:
        """Yield what is not written of a part, but follows from its keys."""
        if not isinstance(slot, Number):
            return
        if slot in self.envelope.unsent:
            yield "It is not sent: both ends know it, and the checksum covers it."
        match slot.role:
            case "checksum":
                about = CHECKSUMS[slot.method].about
                yield f"The {slot.method} of {listed(slot.of)}: {about}."
            case "address":
                yield from self._addresses(slot)

    def _addresses(self, slot: Number) -> Iterator[str]:
        if slot.narrowed:
            yield f"Devices have {slot.low}..{slot.high}."
        part = self.model.spec.envelopes[self.name][slot.name]
        values: dict[str, NamedAddress] = getattr(part, "values", {})
        for name, value in values.items():
            silent = " Nobody answers." if value.silent else ""
            yield f"{value.value} is {name}: {value.about or 'an address of its own.'}{silent}"
