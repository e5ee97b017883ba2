"""The envelope of a frame: all of it but the fields of its message."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from .places import Placed
from .slots import Body, Constant, List, Number

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from .slots import Slot


@dataclass(frozen=True)
class Envelope:
    """The slots of a frame of any message, the body among them.

    `unsent` are ids that no frame holds: both ends know them, and a checksum covers them.
    """

    name: str
    slots: tuple[Slot, ...]
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

    def _of_role(self, role: str) -> tuple[Number, ...]:
        return tuple(slot for slot in self.slots if isinstance(slot, Number) and slot.role == role)

    @cached_property
    def length(self) -> Number | None:
        """The number that says how long the frame is, if there is one."""
        return next(iter(self._of_role("length")), None)

    @property
    def length_name(self) -> str:
        """What the length of a frame is called."""
        return "size" if self.length is None else self.length.name

    @cached_property
    def ids(self) -> tuple[Number, ...]:
        """The numbers that identify the message together, as far as a frame holds them."""
        return self._of_role("id")

    @cached_property
    def id(self) -> Number | None:
        """The last of them, if there is one."""
        return self.ids[-1] if self.ids else None

    @cached_property
    def checksums(self) -> tuple[Number, ...]:
        """The numbers worked out from other parts, in turn: one that another covers comes first."""
        sums = {slot.name: slot for slot in self._of_role("checksum")}
        return tuple(sums[name] for name in in_turn({name: sums[name].of for name in sums}))

    @cached_property
    def body_at(self) -> int:
        """The offset of the fields."""
        return next(slot.at for slot in self.slots if isinstance(slot, Body))

    @cached_property
    def least(self) -> int:
        """The size of a frame without any field."""
        return sum(slot.size for slot in self.slots)

    @cached_property
    def uncounted(self) -> int:
        """The number of bytes of a frame that its length does not count."""
        if self.length is None:
            return 0
        return sum(slot.size for slot in self.slots if slot.name not in self.length.of)

    @cached_property
    def head(self) -> tuple[Placed, ...]:
        """The slots in front of the fields with their places, the same in every frame."""
        return tuple(
            Placed(slot.name, slot.at, slot.size, slot)
            for slot in self.slots
            if 0 <= slot.at < self.body_at and not isinstance(slot, (Body, List))
        )


def in_turn(covered: Mapping[str, Collection[str]]) -> list[str]:
    """Return the checksums of a frame in turn: one that another covers comes first.

    `covered` are the parts that each is worked out from, by their names.
    """
    left, found = [*covered], list[str]()
    while left:
        free = (each for each in left if not {*left} & {*covered[each]} - {each})
        found.append(next(free, left[0]))
        left.remove(found[-1])
    return found
