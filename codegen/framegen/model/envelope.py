"""The envelope of a frame: the slots that a spec lists under `frame`, or under one of `frames`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.protocol.envelope import in_turn

from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import (
    AddressPart,
    BodyPart,
    ChecksumPart,
    ConstantPart,
    IdPart,
    LengthPart,
    NumberField,
    ReservedPart,
)
from framegen.model.covered import Covered
from framegen.model.slots import Body, Constant, Number, Placed, lay_out

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.language.spec import Frame, FramePart, NumberPart
    from framegen.model.slots import ByteOrder


@dataclass(frozen=True)
class Envelope:
    """The slots of a frame of any message, the body among them.

    `unsent` are ids that no frame holds: both ends know them, and a checksum covers them.
    """

    slots: tuple[Constant | Number | Body, ...]
    name: str = "frame"
    unsent: tuple[Number, ...] = ()

    @cached_property
    def header(self) -> bytes:
        """The constant bytes with which a frame begins; b"" where it begins otherwise."""
        found = b""
        for slot in self.slots:
            if not isinstance(slot, Constant) or slot.role == "reserved":
                break
            found += slot.data
        return found

    @cached_property
    def first_bytes(self) -> frozenset[int]:
        """The bytes with which a frame may begin."""
        first = self.slots[0]
        if self.header:
            return frozenset(self.header[:1])
        if not isinstance(first, Number) or first.role != "address":
            return frozenset(range(0x100))
        shift = 8 * (first.size - 1) if first.order == "big" else 0
        low, high = first.low >> shift, first.high >> shift
        begun = {each & 0xFF for each in range(low, min(high, low + 0xFF) + 1)}
        return frozenset({*begun, *(first.write(named)[0] for named in first.named)})

    def begins(self, data: bytes) -> bool:
        """Tell whether a frame may begin with these bytes, as far as its header goes."""
        return data.startswith(self.header) if self.header else data[0] in self.first_bytes

    # Its numbers.

    @cached_property
    def length_part(self) -> Number | None:
        """The number that says how long the frame is, if there is one."""
        return next(self._of_role("length"), None)

    @property
    def length(self) -> Number:
        """The number that says how long the frame is, of an envelope that has one."""
        if self.length_part is None:
            raise AssertionError(f"frames of {self.name} have no length")
        return self.length_part

    @cached_property
    def ids(self) -> tuple[Number, ...]:
        """The numbers that identify the message together, those not sent among them."""
        return (*self.sent_ids, *self.unsent)

    @cached_property
    def sent_ids(self) -> tuple[Number, ...]:
        """Those of them that a frame has: the first ones."""
        return tuple(self._of_role("id"))

    @cached_property
    def id_part(self) -> Number | None:
        """The last number by which a frame tells its message, if there is one."""
        return self.sent_ids[-1] if self.sent_ids else None

    @property
    def id(self) -> Number:
        """The last number by which a frame tells its message, of an envelope that has one."""
        if self.id_part is None:
            raise AssertionError(f"frames of {self.name} have no id")
        return self.id_part

    @cached_property
    def address(self) -> Number | None:
        """The number of the device, if there is one."""
        return next(self._of_role("address"), None)

    @cached_property
    def counter(self) -> Number | None:
        """The running number, if there is one."""
        return next(self._of_role("counter"), None)

    @cached_property
    def given(self) -> tuple[Number, ...]:
        """The numbers that a user gives with every message: the address, and the running number."""
        return tuple(slot for slot in (self.address, self.counter) if slot is not None)

    @cached_property
    def checksums(self) -> tuple[Number, ...]:
        """The numbers worked out from other parts, in turn."""
        sums = {part.name: part for part in self._of_role("checksum")}
        return tuple(sums[name] for name in in_turn({name: sums[name].of for name in sums}))

    @property
    def proven(self) -> bool:
        """Whether a frame proves by itself that it is one."""
        return bool(self.checksums)

    def _of_role(self, role: str) -> Iterator[Number]:
        return (slot for slot in self.slots if isinstance(slot, Number) and slot.role == role)

    # Its places.

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
    def tail_size(self) -> int:
        """The number of bytes behind the fields."""
        return sum(slot.size for slot in self.tail)

    @cached_property
    def _fixed(self) -> tuple[Constant | Number, ...]:
        return tuple(slot for slot in self.slots if isinstance(slot, Constant | Number))

    @cached_property
    def least(self) -> int:
        """The size of a frame without any field."""
        return sum(slot.size for slot in self._fixed)

    @cached_property
    def uncounted(self) -> int:
        """The number of bytes of a frame that its length does not count.

        Without a length part, the length of a frame is its size.
        """
        if self.length_part is None:
            return 0
        return sum(slot.size for slot in self._fixed if slot.name not in self.length.of)

    @property
    def counted(self) -> int:
        """The number of bytes that the length counts besides the fields."""
        return self.least - self.uncounted

    @property
    def longest(self) -> int | None:
        """The size of the largest frame that its length can say; None without a length."""
        return None if self.length_part is None else self.length_part.high + self.uncounted

    @property
    def legal_ids(self) -> range:
        """The ids that a message can have."""
        return range(self.id.low, self.id.high + 1)

    @property
    def proves_unknown(self) -> bool:
        """Whether a frame of unknown id proves by itself that it is one."""
        return self.proven and self.length_part is not None and not self.unsent

    def covered(self, checksum: Number, ids: Mapping[str, int]) -> Covered:
        """Return what a checksum is worked out from, in a frame with these ids by part."""
        hidden = {
            part.name: part.write(ids[part.name])
            for part in self.unsent
            if part.name in checksum.of
        }
        key = checksum.of, (*hidden.values(),)
        if key not in self._covered:
            self._covered[key] = self._pieces(checksum.of, hidden)
        return self._covered[key]

    @cached_property
    def _covered(self) -> dict[tuple[tuple[str, ...], tuple[bytes, ...]], Covered]:
        """What checksums are worked out from, found once because it is needed for every frame."""
        return {}

    def _pieces(self, names: Iterable[str], hidden: Mapping[str, bytes]) -> Covered:
        found = Covered()
        for name in names:
            if name in hidden:
                found = found.then(hidden[name])
            for slot in self.slots:
                if slot.name == name:
                    end = -self.tail_size if isinstance(slot, Body) else slot.at + slot.size
                    found = found.then((slot.at, end or None))
        return found

    def sealed(self, data: bytes, ids: Mapping[str, int]) -> bytes:
        """Return a whole frame with these ids by part, with the checksums that it should have."""
        for checksum in self.checksums:
            at = checksum.at if checksum.at >= 0 else len(data) + checksum.at
            right = self.covered(checksum, ids).checksum(checksum, data)
            data = data[:at] + right + data[at + checksum.size :]
        return data

    def lay_out(self, size: int) -> Iterator[Placed]:
        """Place the slots of a frame of `size` bytes; its fields are one piece."""
        return lay_out(self.slots, size)


def derive_envelope(parts: Frame, order: ByteOrder, name: str = "frame") -> Envelope:
    """Place the parts of a frame. Needs parts that keep the rule frame-parts."""
    slots: list[Constant | Number | Body] = []
    unsent: list[Number] = []
    at = 0
    left = sum(map(_size_of, parts.values()))
    for part_name, part in parts.items():
        left -= _size_of(part)
        if isinstance(part, BodyPart):
            slots.append(Body(part_name, at, part.about))
            at = -left
            continue
        if isinstance(part, ConstantPart | ReservedPart):
            slots.append(Constant(part_name, at, part.bytes_, part.about, part.is_))
        elif isinstance(part, IdPart) and not part.sent:
            unsent.append(_number(part_name, part, at, order))
            continue
        else:
            slots.append(_number(part_name, part, at, order))
        at += _size_of(part)
    return Envelope(tuple(slots), name, tuple(unsent))


def _number(name: str, part: NumberPart, at: int, order: ByteOrder) -> Number:
    of: tuple[str, ...] = ()
    method, silent = "", frozenset[int]()
    said: Mapping[str, object] = {
        "type": part.type,
        "about": part.about,
        "byte_order": part.byte_order,
        "notes": part.notes,
    }
    match part:
        case LengthPart():
            of = tuple(part.counts)
        case ChecksumPart():
            of, method = tuple(part.covers), part.method
        case AddressPart():
            silent = frozenset(each.value for each in part.values.values() if each.silent)
            named = {
                name: {
                    "value": each.value,
                    "about": each.about,
                    "cite": _written(each.cite),
                    "was": [*each.was],
                }
                for name, each in part.values.items()
            }
            said = {**said, "range": _written(part.range), "values": named}
    field = NumberField.model_validate(
        {key: each for key, each in said.items() if each is not None}
    )
    its_order = part.byte_order or order
    number_type = NUMBER_TYPES[part.type]
    return Number(name, part.is_, at, number_type, its_order, field, of, method, silent)


def _written(value: object) -> str | None:
    return None if value is None else str(value)


def _size_of(part: FramePart) -> int:
    """Return the size of a part of a frame in bytes; 0 for the body, whose size varies."""
    if isinstance(part, ConstantPart | ReservedPart):
        return len(part.bytes_)
    if isinstance(part, BodyPart) or (isinstance(part, IdPart) and not part.sent):
        return 0
    return NUMBER_TYPES[part.type].size
