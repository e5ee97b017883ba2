"""Where the slots of a frame of known size are."""

from __future__ import annotations

from dataclasses import dataclass

from .slots import Body, List, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from .slots import Constant, Number, Packed, Slot


@dataclass(frozen=True)
class Placed:
    """A slot in a frame of known size, with its path and its place."""

    path: str
    at: int
    size: int
    slot: Constant | Number | Text | Packed | Body

    @property
    def end(self) -> int:
        """The offset behind the last byte."""
        return self.at + self.size


def lay_out(slots: Iterable[Slot], size: int, count: int = 0) -> Iterator[Placed]:
    """Place the slots of a frame of `size` bytes with `count` elements, in order."""
    slots = list(slots)
    for slot in slots:
        at = from_front(slot.at, size)
        if isinstance(slot, Body):
            yield Placed(slot.name, at, size - sum(each.size for each in slots), slot)
        elif not isinstance(slot, List):
            yield Placed(slot.name, at, slot.size, slot)
        elif slot.text:
            yield _text(slot, at, slot.low if slot.is_fixed else count)
        else:
            for index in range(slot.low if slot.is_fixed else count):
                start = at + index * slot.size
                for each in slot.fields:
                    yield Placed(slot.path(index, each), start + each.at, each.size, each)


def _text(items: List, at: int, count: int) -> Placed:
    """Return the text of a list of characters, as one slot."""
    (character,) = items.fields
    text = Text(
        name=items.name,
        at=at,
        size=count,
        charset=items.text,
        about=character.about,
        whole=True,
    )
    return Placed(items.name, at, count, text)


def from_front(at: int, size: int) -> int:
    """Convert a place that may count from the end of a frame into an offset."""
    return at if at >= 0 else size + at
