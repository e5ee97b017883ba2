"""The envelope of every frame: the slots that a spec lists under `frame`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import (
    BodyPart,
    ChecksumPart,
    ConstantPart,
    LengthPart,
    NumberField,
)
from framegen.model.slots import Body, Constant, Number, Placed, lay_out

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.spec import AddressPart, FramePart, IdPart
    from framegen.model.slots import ByteOrder


@dataclass(frozen=True)
class Envelope:
    """The slots of a frame of any message, the body among them."""

    slots: tuple[Constant | Number | Body, ...]

    @cached_property
    def header(self) -> bytes:
        """The constant bytes with which a frame begins."""
        found = b""
        for slot in self.slots:
            if not isinstance(slot, Constant):
                break
            found += slot.data
        return found

    @cached_property
    def opening(self) -> str:
        """The beginning of a frame, in words."""
        return f"a frame begins {self.header.hex(' ').upper()}"

    @cached_property
    def shortest(self) -> str:
        """The size of the shortest frame, in words."""
        return f"the shortest frame has {self.least} bytes"

    @cached_property
    def length(self) -> Number:
        """The number that says how long the frame is."""
        return self._only("length")

    @cached_property
    def id(self) -> Number:
        """The number that identifies the message."""
        return self._only("id")

    def _only(self, role: str) -> Number:
        for slot in self.slots:
            if isinstance(slot, Number) and slot.role == role:
                return slot
        raise AssertionError("the rule frame-parts sees to both")

    @cached_property
    def body_at(self) -> int:
        """The offset of the fields."""
        return next(slot.at for slot in self.slots if isinstance(slot, Body))

    @cached_property
    def head(self) -> tuple[Constant | Number, ...]:
        """The slots in front of the fields."""
        return tuple(slot for slot in self._fixed if 0 <= slot.at < self.body_at)

    @cached_property
    def placed_head(self) -> tuple[Placed, ...]:
        """The slots in front of the fields with their places, the same in every frame."""
        return tuple(Placed(slot.name, slot.at, slot.size, slot) for slot in self.head)

    @cached_property
    def tail(self) -> tuple[Constant | Number, ...]:
        """The slots behind the fields, with places that count from the end."""
        return tuple(slot for slot in self._fixed if slot.at < 0)

    @cached_property
    def _fixed(self) -> tuple[Constant | Number, ...]:
        return tuple(slot for slot in self.slots if isinstance(slot, Constant | Number))

    @cached_property
    def least(self) -> int:
        """The size of a frame without any field."""
        return sum(slot.size for slot in self._fixed)

    @cached_property
    def uncounted(self) -> int:
        """The number of bytes of a frame that its length does not count."""
        return sum(slot.size for slot in self._fixed if slot.name not in self.length.of)

    @property
    def counted(self) -> int:
        """The number of bytes that the length counts besides the fields."""
        return self.least - self.uncounted

    @property
    def legal_ids(self) -> range:
        """The ids that a message can have."""
        return range(self.id.low, self.id.high + 1)

    def lay_out(self, size: int) -> Iterator[Placed]:
        """Place the slots of a frame of `size` bytes; its fields are one piece."""
        return lay_out(self.slots, size)


def derive_envelope(parts: Mapping[str, FramePart], order: ByteOrder) -> Envelope:
    """Place the parts of a frame. Needs parts that keep the rule frame-parts."""
    slots: list[Constant | Number | Body] = []
    at = 0
    left = sum(map(_size_of, parts.values()))
    for name, part in parts.items():
        left -= _size_of(part)
        if isinstance(part, BodyPart):
            slots.append(Body(name, at, part.about))
            at = -left
            continue
        if isinstance(part, ConstantPart):
            slots.append(Constant(name, at, part.bytes_, part.about))
        else:
            slots.append(_number(name, part, at, order))
        at += _size_of(part)
    return Envelope(tuple(slots))


def _number(
    name: str, part: LengthPart | IdPart | AddressPart | ChecksumPart, at: int, order: ByteOrder
) -> Number:
    of: tuple[str, ...] = ()
    if isinstance(part, LengthPart):
        of = tuple(part.counts)
    elif isinstance(part, ChecksumPart):
        of = tuple(part.covers)
    field = NumberField.model_validate({"type": part.type, "about": part.about})
    return Number(name, part.is_, at, NUMBER_TYPES[part.type], order, field, of)


def _size_of(part: FramePart) -> int:
    """Return the size of a part of a frame in bytes; 0 for the body, whose size varies."""
    if isinstance(part, ConstantPart):
        return len(part.bytes_)
    return 0 if isinstance(part, BodyPart) else NUMBER_TYPES[part.type].size
