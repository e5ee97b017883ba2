"""The model of a protocol as plain data: slots, messages, and what is written of them."""

from __future__ import annotations

from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from typing import Any


@dataclass(frozen=True)
class Slot:
    """Some bytes of a frame that belong together: a constant, a number, a list or the body.

    Its place counts from the first byte of the frame or, below zero, from its end; in an element
    from the first byte of the element. `said` is the slot as data.
    """

    said: Mapping[str, Any]
    byte_order: str

    @cached_property
    def role(self) -> str:
        """What it is there for, such as `constant`, `length`, `field`, `list` or `body`."""
        return str(self.said["role"])

    @cached_property
    def name(self) -> str:
        """The name."""
        return str(self.said["name"])

    @cached_property
    def at(self) -> int:
        """The place."""
        return int(self.said["at"])

    @cached_property
    def size(self) -> int:
        """The size in bytes; of a list, that of an element; 0 for the body."""
        return int(self.said["size"])

    @cached_property
    def about(self) -> str:
        """What it is."""
        return str(self.said.get("about", ""))

    @cached_property
    def data(self) -> bytes:
        """The bytes of a constant."""
        return bytes.fromhex(self.said.get("bytes", ""))

    @cached_property
    def of(self) -> tuple[str, ...]:
        """The names of the slots that a length counts, or that a checksum covers."""
        return tuple(self.said.get("of", ()))

    @property
    def is_number(self) -> bool:
        """Whether it is a number."""
        return "type" in self.said

    @property
    def is_field(self) -> bool:
        """Whether it belongs to the message; all others belong to the envelope."""
        return self.role in ("count", "field")

    @cached_property
    def low(self) -> int:
        """The lowest value of a number, or the fewest elements of a list."""
        return int(self.said["low"])

    @cached_property
    def high(self) -> int:
        """The highest value of a number, or the most elements of a list."""
        return int(self.said["high"])

    @cached_property
    def fields(self) -> tuple[Slot, ...]:
        """The numbers in an element of a list."""
        return tuple(Slot(field, self.byte_order) for field in self.said["fields"])

    def read(self, data: bytes) -> int:
        """Read a number from its bytes."""
        ordered = data if self.byte_order == "big" else data[::-1]
        return int.from_bytes(ordered, "big", signed=bool(self.said.get("signed")))

    def write(self, value: int) -> bytes:
        """Write a number as bytes. Raises OverflowError where it does not fit."""
        data = value.to_bytes(self.size, "big", signed=bool(self.said.get("signed")))
        return data if self.byte_order == "big" else data[::-1]

    def read_in(self, frame: bytes) -> int:
        """Read a number from `frame`, which holds all of it."""
        at = _from_front(self.at, len(frame))
        return self.read(frame[at : at + self.size])

    def is_in(self, data: bytes) -> bool:
        """Tell whether `data` holds all of it; never, if it is placed from the end."""
        return 0 <= self.at <= len(data) - self.size

    def path(self, index: int | str, field: Slot) -> str:
        """Return the path of a number in an element: `items[0].level`, or `ids[0]`."""
        inner = f".{field.name}" if self.said.get("element") else ""
        return f"{self.name}[{index}]{inner}"

    def in_words(self, value: int) -> tuple[str, str]:
        """Return a value with its unit, in its larger unit and by its name; and its meaning."""
        text = f"{value} {self.said.get('unit', '')}".rstrip()
        if "scale" in self.said:
            step, unit = self.said["scale"]
            text += f" = {value * Decimal(step)} {unit}"
        for name, named in self.said.get("values", {}).items():
            if named["value"] == value:
                return f"{text} ({name})", str(named["about"])
        return text, self.about


@dataclass(frozen=True)
class Placed:
    """A slot in a frame of known size, with its path and its place."""

    path: str
    at: int
    size: int
    slot: Slot

    @property
    def end(self) -> int:
        """The offset behind the last byte."""
        return self.at + self.size

    def of(self, frame: bytes) -> bytes:
        """Return its bytes, as far as `frame` holds them."""
        return frame[self.at : self.end]


@dataclass(frozen=True)
class Envelope:
    """The slots of a frame of any message, the body among them."""

    slots: tuple[Slot, ...]

    @cached_property
    def opening(self) -> str:
        """The beginning of a frame, in words."""
        found = b""
        for slot in self.slots:
            if slot.role != "constant":
                break
            found += slot.data
        return f"a frame begins {found.hex(' ').upper()}"

    @cached_property
    def length(self) -> Slot:
        """The number that says how long the frame is."""
        return next(slot for slot in self.slots if slot.role == "length")

    @cached_property
    def id(self) -> Slot:
        """The number that identifies the message."""
        return next(slot for slot in self.slots if slot.role == "id")

    @cached_property
    def body_at(self) -> int:
        """The offset of the fields."""
        return next(slot.at for slot in self.slots if slot.role == "body")

    @cached_property
    def least(self) -> int:
        """The size of a frame without any field."""
        return sum(slot.size for slot in self.slots)

    @cached_property
    def uncounted(self) -> int:
        """The number of bytes of a frame that its length does not count."""
        return sum(slot.size for slot in self.slots if slot.name not in self.length.of)

    @cached_property
    def head(self) -> tuple[Placed, ...]:
        """The slots in front of the fields with their places, the same in every frame."""
        return tuple(
            Placed(slot.name, slot.at, slot.size, slot)
            for slot in self.slots
            if 0 <= slot.at < self.body_at and slot.role != "body"
        )


@dataclass(frozen=True)
class Message:
    """One message: the slots of its frame. `said` is what is written of it, as data."""

    name: str
    said: Mapping[str, Any]
    frame: Envelope
    byte_order: str

    @property
    def id(self) -> int:
        """The id."""
        return int(self.said["id"])

    @property
    def direction(self) -> str:
        """The sender and the receiver: `client -> device`."""
        return str(self.said["direction"])

    @cached_property
    def fields(self) -> tuple[Slot, ...]:
        """The slots of the message between head and tail: counts, numbers and the list."""
        return tuple(Slot(field, self.byte_order) for field in self.said["fields"])

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """The slots from the first byte to the last: those of the envelope around the fields."""
        found: list[Slot] = []
        for slot in self.frame.slots:
            found += self.fields if slot.role == "body" else [slot]
        return tuple(found)

    @cached_property
    def items(self) -> Slot | None:
        """The list, where the message has one."""
        return next((slot for slot in self.fields if slot.role == "list"), None)

    @cached_property
    def _fixed(self) -> int:
        """The length of a frame without elements."""
        sizes = (slot.size for slot in self.slots if slot.role != "list")
        return sum(sizes) - self.frame.uncounted

    @cached_property
    def formula(self) -> str:
        """The length rule: `3 * count + 5`, or a number."""
        if self.items is None:
            return str(self._fixed)
        count, size = self.items.said["counter"], self.items.size
        term = count if size == 1 else f"{size} * {count}"
        return f"{term} + {self._fixed}" if self._fixed else term

    @cached_property
    def lengths(self) -> range:
        """The legal values of the length."""
        if self.items is None:
            return range(self._fixed, self._fixed + 1)
        size = self.items.size
        low, high = (self._fixed + size * count for count in (self.items.low, self.items.high))
        return range(low, high + 1, size)

    @property
    def largest(self) -> int:
        """The size of the largest legal frame in bytes."""
        return self.lengths[-1] + self.frame.uncounted

    def count_at(self, length: int) -> int:
        """Return the number of elements of a frame with this legal length."""
        return 0 if self.items is None else self.items.low + self.lengths.index(length)

    def lay_out(self, length: int) -> Iterator[Placed]:
        """Place the slots of a frame with this legal length, from its first byte on."""
        return lay_out(self.slots, length + self.frame.uncounted, self.count_at(length))


@dataclass(frozen=True)
class Lookalike:
    """Another protocol that is easily taken for this one, and the envelope of its frames."""

    said: Mapping[str, Any]
    frame: Envelope

    @property
    def title(self) -> str:
        """What it is called."""
        return str(self.said["title"])

    @cached_property
    def commands(self) -> dict[int, str]:
        """The meanings of ids there."""
        return {int(number): text for number, text in self.said["commands"].items()}


@dataclass(frozen=True)
class Protocol:
    """A protocol. `said` is all of it, as data."""

    said: Mapping[str, Any]

    @property
    def title(self) -> str:
        """What people call it."""
        return str(self.said["title"])

    @property
    def directions(self) -> list[str]:
        """The directions that messages have, the client's first."""
        return list(self.said["directions"])

    @cached_property
    def frame(self) -> Envelope:
        """The envelope of every frame."""
        return self._envelope(self.said["frame"])

    @cached_property
    def messages(self) -> dict[str, Message]:
        """The messages, by name."""
        order = self.said["byte_order"]
        return {
            name: Message(name, said, self.frame, order)
            for name, said in self.said["messages"].items()
        }

    @cached_property
    def _by_id(self) -> dict[tuple[str, int], Message]:
        return {(message.direction, message.id): message for message in self.messages.values()}

    def message(self, direction: str, number: int) -> Message | None:
        """Return the message of a direction that has an id; None for no such message."""
        return self._by_id.get((direction, number))

    @cached_property
    def lookalikes(self) -> dict[str, Lookalike]:
        """The look-alikes, by name; one without a frame has the protocol's own."""
        return {
            name: Lookalike(said, self._envelope(said["frame"]) if "frame" in said else self.frame)
            for name, said in self.said["lookalikes"].items()
        }

    def _envelope(self, slots: Iterable[Mapping[str, Any]]) -> Envelope:
        return Envelope(tuple(Slot(slot, self.said["byte_order"]) for slot in slots))

    def largest(self, directions: Iterable[str]) -> int:
        """Return the size of the largest legal frame of these directions; 0 for no messages."""
        chosen = set(directions)
        sizes = (each.largest for each in self.messages.values() if each.direction in chosen)
        return max(sizes, default=0)

    def source(self, cite: str) -> tuple[str, str]:
        """Return the source of a citation by its title, and its kind where it does not decide."""
        name, _, place = cite.partition(", ")
        source = self.said["sources"].get(name, {"title": name, "kind": ""})
        marked = name != self.said["authority"]
        return ", ".join(filter(None, (source["title"], place))), source["kind"] if marked else ""


def lay_out(slots: Iterable[Slot], size: int, count: int = 0) -> Iterator[Placed]:
    """Place the slots of a frame of `size` bytes with `count` elements, in order."""
    slots = list(slots)
    for slot in slots:
        at = _from_front(slot.at, size)
        if slot.role == "list":
            for index in range(count):
                start = at + index * slot.size
                for field in slot.fields:
                    path = slot.path(index, field)
                    yield Placed(path, start + field.at, field.size, field)
        elif slot.role == "body":
            yield Placed(slot.name, at, size - sum(each.size for each in slots), slot)
        else:
            yield Placed(slot.name, at, slot.size, slot)


def _from_front(at: int, size: int) -> int:
    """Convert a place that may count from the end of a frame into an offset."""
    return at if at >= 0 else size + at
