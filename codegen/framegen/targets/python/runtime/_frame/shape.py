"""The properties that the fields of a message give to all of its frames."""

from __future__ import annotations

from itertools import count as upwards

from .items import Items
from .number import Number
from .protocol import BODY_AT

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any


class Shape:
    """The fields of a class of messages, in the order of the frame, and the rules for its frames.

    `numbers` stand in front of the list, its count among them; `items` is the list, if there is
    one; `lengths` are the legal ones.
    """

    __slots__ = ("items", "lengths", "narrowed", "numbers")

    def __init__(self, kind: type, lengths: range) -> None:
        fields = [each for base in reversed(kind.__mro__) for each in vars(base).values()]
        self.numbers = tuple(each for each in fields if isinstance(each, Number))
        lists: list[Items[Any]] = [each for each in fields if isinstance(each, Items)]
        self.items = lists[0] if lists else None
        self.lengths = lengths
        # Whether a field has a range of its own, narrower than what struct accepts.
        inside = self.items.fields if self.items is not None else ()
        self.narrowed = any(number.narrowed for number in (*self.numbers, *inside))

    def count_bytes(self, length: int) -> tuple[int, int, bytes]:
        """Return where the count of a frame of legal length stands, from and to, and its bytes."""
        if self.items is None:
            return 0, 0, b""
        count = self.items.counts[self.lengths.index(length)]
        at, data = self.items.count.at, self.items.count.struct.pack(count)
        return at, at + len(data), data

    def out_of_range(self, frame: bytes) -> tuple[int, str] | None:
        """Return the first number of a frame outside its range: its offset, and what is wrong.

        If the frame is cut short, a number that is not complete is skipped.
        """
        at = BODY_AT
        for _, field in self._fields() if self.narrowed else ():
            if at + field.struct.size > len(frame):
                break
            (value,) = field.struct.unpack_from(frame, at)
            if not field.low <= value <= field.high:
                return at, f"{field.name} is {value}, outside {field.low}..{field.high}"
            at += field.struct.size
        return None

    def checked(self, numbers: Sequence[Any]) -> list[int]:
        """Return the numbers of a frame as ints. Raises EncodeError for the first wrong one."""
        return [
            field.checked(number, path)
            for number, (path, field) in zip(numbers, self._fields(), strict=False)
        ]

    def _fields(self) -> Iterator[tuple[str, Number]]:
        """Yield each number of a frame with its path; those of a list without end."""
        for number in self.numbers:
            yield number.name, number
        if self.items is not None:
            for position in upwards():
                yield from self.items.one(position)
