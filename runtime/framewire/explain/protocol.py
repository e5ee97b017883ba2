"""The model of a protocol as plain data: slots, messages, and what is written of them."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from decimal import Context, Decimal
from functools import cached_property

from .checksum import checksum, in_turn

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from typing import Any, TypeAlias

    # What a slot can hold.
    Value: TypeAlias = float | str | list[int]

FORM = 1
"""The form of the data. It goes up when a key means something else, or is gone: new keys do not
count, since readers pass over what they do not know."""

# Digits for any number of 64 bits in steps of any size, none of them rounded.
_EXACT = Context(prec=64)
# Those of a byte.
_BITS = 8


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
        return self.role in ("count", "size", "field", "text") or "field" in self.said

    @property
    def is_float(self) -> bool:
        """Whether it is a floating-point number."""
        return str(self.said.get("type", "")).startswith("f")

    @property
    def is_fixed(self) -> bool:
        """Whether a list always has the same number of elements."""
        return bool(self.said.get("fixed"))

    @property
    def order(self) -> str:
        """The byte order of a number, its own or that of the protocol."""
        return str(self.said.get("byte_order", self.byte_order))

    @property
    def order_in_words(self) -> str:
        """Which byte of a number comes first: `low byte first`; "" for one byte, and for others.

        Of packed numbers, it says in which bits the first one is, too.
        """
        first = "low" if self.order == "little" else "high"
        if self.role == "packed":
            whole = f"{first} byte and " if self.size > 1 else ""
            return f"{whole}{first} bits first"
        kind = str(self.said.get("type", self.said.get("of_type", "u8")))
        return f"{first} byte first" if int(kind[1:]) > _BITS else ""

    @property
    def kind(self) -> str:
        """What it holds: a type, `text`, several of a type, or the method of a checksum."""
        if self.role == "packed":
            return f"{self.said['count']} of {self.said['packed']}"
        if self.role == "checksum":
            return str(self.said["method"])
        if self.role in ("constant", "reserved"):
            return str(self.said.get("of_type", ""))
        return str(self.said.get("type", "text"))

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
        """Read a whole number from its bytes."""
        ordered = data if self.order == "big" else data[::-1]
        return int.from_bytes(ordered, "big", signed=bool(self.said.get("signed")))

    def value(self, data: bytes) -> Value:
        """Return the value of its bytes: a number, a text, or all the numbers of a packed list."""
        if self.role == "text":
            text = data if self.said.get("whole") else data.rstrip(b"\0")
            return text.decode(self.said["charset"], "backslashreplace")
        if self.role == "packed":
            return self._packed(data)
        if not self.is_float:
            return self.read(data)
        (value,) = struct.unpack((">" if self.order == "big" else "<") + "fd"[self.size > 4], data)
        return float(value)

    def _packed(self, data: bytes) -> list[int]:
        bits, count = int(self.said["packed"][1:]), int(self.said["count"])
        whole = int.from_bytes(data if self.order == "big" else data[::-1], "big")
        found = [whole >> bits * number & (1 << bits) - 1 for number in range(count)]
        return found[::-1] if self.order == "big" else found

    def write(self, value: int) -> bytes:
        """Write a whole number as bytes. Raises OverflowError where it does not fit."""
        data = value.to_bytes(self.size, "big", signed=bool(self.said.get("signed")))
        return data if self.order == "big" else data[::-1]

    def holds(self, data: bytes) -> bool:
        """Tell whether it may have these bytes, as far as they tell it by themselves."""
        if self.role == "constant":
            return data == self.data
        if self.role == "text":
            return data.isascii()
        if "low" not in self.said:
            return True
        found = self._packed(data) if self.role == "packed" else [self.read(data)]
        # Names of addresses may lie outside the range.
        named = self.said.get("values", {}) if self.role == "address" else {}
        names = [each["value"] for each in named.values()]
        return all(self.low <= each <= self.high or each in names for each in found)

    def checksum(self, data: bytes) -> int:
        """Work out a checksum of `data`."""
        found: int = checksum(self.said["terms"], 8 * self.size, data)
        return found

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

    def scaled(self, value: float) -> Decimal:
        """Return a number that has a scale in its larger unit, with no digit rounded."""
        step, _, *offset = self.said["scale"]
        scaled = _EXACT.multiply(Decimal(str(value)), Decimal(step))
        for each in offset:
            scaled = _EXACT.add(scaled, Decimal(each))
        return scaled

    def in_words(self, value: Value) -> tuple[str, str]:
        """Return a value with its unit, in its larger unit and by its name; and its meaning."""
        if isinstance(value, list | str):
            text = " ".join(map(str, value)) if isinstance(value, list) else repr(value)
            return text, self.about
        text = f"{value} {self.said.get('unit', '')}".rstrip()
        if "scale" in self.said:
            text += f" = {self.scaled(value):f} {self.said['scale'][1]}".rstrip()
        set_bits = ", ".join(self.bits_in_words(int(value))) if "bits" in self.said else ""
        text += f" ({set_bits})" if set_bits else ""
        for name, named in self.said.get("values", {}).items():
            if named["value"] == value:
                return f"{text} ({name})", str(named.get("about", self.about))
        return text, self.about

    def bits_in_words(self, value: int) -> Iterator[str]:
        """Yield the named bits of a number that are set, those of several bits with their value."""
        for name, (low, high, _) in self.said.get("bits", {}).items():
            found = value >> low & (1 << high - low + 1) - 1
            if found:
                yield name if low == high else f"{name} {found}"


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
    """The slots of a frame of any message, the body among them.

    `unsent` are ids that no frame holds: both ends know them, and a checksum covers them.
    """

    slots: tuple[Slot, ...]
    name: str = "frame"
    unsent: tuple[Slot, ...] = ()

    @cached_property
    def header(self) -> bytes:
        """The constant bytes with which a frame begins; b"" where it begins otherwise."""
        found = b""
        for slot in self.slots:
            if slot.role != "constant":
                break
            found += slot.data
        return found

    @cached_property
    def opening(self) -> str:
        """The beginning of a frame, in words."""
        if self.header:
            return self.header.hex(" ").upper()
        first = self.slots[0]
        bounds = f", {first.low}..{first.high}" if first.role == "address" else ""
        return f"with its {first.name}{bounds}"

    @cached_property
    def length(self) -> Slot | None:
        """The number that says how long the frame is, if there is one."""
        return next((slot for slot in self.slots if slot.role == "length"), None)

    @cached_property
    def ids(self) -> tuple[Slot, ...]:
        """The numbers that identify the message together, as far as a frame holds them."""
        return tuple(slot for slot in self.slots if slot.role == "id")

    @cached_property
    def id(self) -> Slot | None:
        """The last of them, if there is one."""
        return self.ids[-1] if self.ids else None

    @cached_property
    def checksums(self) -> tuple[Slot, ...]:
        """The numbers worked out from other parts, in turn."""
        sums = {slot.name: slot for slot in self.slots if slot.role == "checksum"}
        return tuple(sums[name] for name in in_turn({name: sums[name].of for name in sums}))

    def right(self, part: Slot, frame: bytes, unsent: Sequence[int] = ()) -> bytes:
        """Return a checksum as a whole frame should have it; `unsent` are the ids not in it."""
        hidden = zip(self.unsent, unsent, strict=False)
        pieces = {slot.name: slot.write(number) for slot, number in hidden}
        pieces |= {placed.path: placed.of(frame) for placed in lay_out(self.slots, len(frame))}
        return part.write(part.checksum(b"".join(pieces.get(name, b"") for name in part.of)))

    def sealed(self, frame: bytes, unsent: Sequence[int] = ()) -> bytes:
        """Return a whole frame with the checksums that it should have."""
        mended = bytearray(frame)
        for part in self.checksums:
            at = _from_front(part.at, len(frame))
            mended[at : at + part.size] = self.right(part, bytes(mended), unsent)
        return bytes(mended)

    def length_of(self, data: bytes) -> int:
        """Return the length of a frame that `data` begins; without a length part, its size."""
        return len(data) if self.length is None else self.length.read_in(data)

    @property
    def length_name(self) -> str:
        """What the length of a frame is called."""
        return "size" if self.length is None else self.length.name

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
        if self.length is None:
            return 0
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

    @cached_property
    def ids(self) -> tuple[int, ...]:
        """The ids, one for each id part of its envelope."""
        if "ids" in self.said:
            return tuple(self.said["ids"])
        return (int(self.said["id"]),) if "id" in self.said else ()

    @property
    def seen_ids(self) -> tuple[int, ...]:
        """Those ids that a frame holds."""
        return self.ids[: len(self.frame.ids)]

    @property
    def unsent_ids(self) -> tuple[int, ...]:
        """Those ids that no frame holds."""
        return self.ids[len(self.frame.ids) :]

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
        """The list of a size that varies, where the message has one."""
        lists = (slot for slot in self.fields if slot.role == "list")
        return next((slot for slot in lists if not slot.is_fixed), None)

    @cached_property
    def optional(self) -> tuple[Slot, ...]:
        """The fields that may be absent, each with those behind it."""
        return tuple(slot for slot in self.fields if slot.said.get("optional"))

    @cached_property
    def _fixed(self) -> int:
        """The length of a frame without elements, and without what may be absent."""
        sizes = 0
        for slot in self.slots:
            if slot is not self.items and slot not in self.optional:
                sizes += slot.size * (slot.low if slot.is_fixed else 1)
        return sizes - self.frame.uncounted

    @cached_property
    def formula(self) -> str:
        """The length rule: `3 * count + 5`, or a number, or several."""
        if self.items is None:
            return ", ".join(map(str, self.lengths))
        said, size = self.items.said, self.items.size
        count = said.get("variable") or said.get("counter", self.items.name)
        term = count if size == 1 else f"{size} * {count}"
        return f"{term} + {self._fixed}" if self._fixed else term

    @cached_property
    def varies(self) -> bool:
        """Whether its frames have several lengths."""
        return len(self.lengths) > 1

    @cached_property
    def lengths(self) -> Sequence[int]:
        """The legal values of the length."""
        if self.items is None:
            return self.said.get("lengths") or range(self._fixed, self._fixed + 1)
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

    def counted_at(self, counter: Slot, length: int) -> int:
        """Return the value of a counter of the list in a frame with this legal length."""
        count = self.count_at(length)
        is_size = counter.role == "size" and self.items is not None
        return count * self.items.size if is_size and self.items is not None else count

    def length_of(self, data: bytes) -> int | None:
        """Return the legal length of the frame that `data` begins; None if there is none."""
        if self.frame.length is not None:
            length: int | None = self.frame.length.read_in(data)
        elif self.items is None or "counter" not in self.items.said:
            length = self.lengths[0]
        else:
            name = self.items.said["counter"]
            counter = next(slot for slot in self.fields if slot.name == name)
            if not counter.is_in(data):
                return None
            count, rest = counter.read_in(data), 0
            if counter.role == "size":
                count, rest = divmod(count, self.items.size)
            length = None if rest else self._fixed + self.items.size * count
        return length if length in self.lengths else None

    def lay_out(self, length: int) -> Iterator[Placed]:
        """Place the slots of a frame with this legal length, from its first byte on."""
        count = self.count_at(length)
        size = length + self.frame.uncounted
        end = size - sum(slot.size for slot in self.slots if slot.at < 0)
        there = [slot for slot in self.slots if slot not in self.optional or slot.at < end]
        return lay_out(there, size, count)


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
    def envelopes(self) -> dict[str, Envelope]:
        """Every envelope by name; the only one is called `frame`."""
        frames = self.said.get("frames") or {"frame": self.said["frame"]}
        return {name: self._envelope(slots, name) for name, slots in frames.items()}

    @cached_property
    def frame(self) -> Envelope:
        """The envelope of every frame; where there are several, the first."""
        return next(iter(self.envelopes.values()))

    @cached_property
    def messages(self) -> dict[str, Message]:
        """The messages, by name."""
        order = self.said["byte_order"]
        return {
            name: Message(name, said, self.envelopes[said.get("frame", self.frame.name)], order)
            for name, said in self.said["messages"].items()
        }

    @cached_property
    def _sent(self) -> dict[tuple[str, str], list[Message]]:
        found: dict[tuple[str, str], list[Message]] = {}
        for message in self.messages.values():
            found.setdefault((message.direction, message.frame.name), []).append(message)
        return found

    def sent(self, direction: str, frame: Envelope) -> Sequence[Message]:
        """Return the messages of a direction in frames of an envelope."""
        return self._sent.get((direction, frame.name), ())

    def begun(self, direction: str, frame: Envelope, data: bytes) -> Sequence[Message]:
        """Return the messages of a direction that `data` begins: none until its ids tell."""
        ids = tuple(part.read_in(data) for part in frame.ids if part.is_in(data))
        found = [each for each in self.sent(direction, frame) if each.seen_ids[: len(ids)] == ids]
        if len(found) == 1:
            return found
        if len(ids) < len(frame.ids):
            return ()
        if frame.length is not None and frame.length.is_in(data):
            return [each for each in found if each.length_of(data) is not None] or found
        return found

    @cached_property
    def lookalikes(self) -> dict[str, Lookalike]:
        """The look-alikes, by name; one without a frame has the protocol's own."""
        return {
            name: Lookalike(said, self._envelope(said["frame"]) if "frame" in said else self.frame)
            for name, said in self.said["lookalikes"].items()
        }

    def _envelope(self, slots: Iterable[Mapping[str, Any]], name: str = "frame") -> Envelope:
        order = self.said["byte_order"]
        made = [Slot(slot, order) for slot in slots]
        unsent = [slot for slot in made if not slot.said.get("sent", True)]
        return Envelope(tuple(slot for slot in made if slot not in unsent), name, tuple(unsent))

    def opening(self, directions: Iterable[str]) -> str:
        """Return the beginning of a frame of these directions, in words."""
        ways = list(directions)
        found = (
            each for each in self.envelopes.values() if any(self.sent(way, each) for way in ways)
        )
        openings = list(dict.fromkeys(each.opening for each in found)) or [self.frame.opening]
        return f"a frame begins {listed(openings, 'or')}"

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
        if slot.role == "list" and "text" in slot.said:
            yield _text(slot, at, slot.low if slot.is_fixed else count)
        elif slot.role == "list":
            for index in range(slot.low if slot.is_fixed else count):
                start = at + index * slot.size
                for field in slot.fields:
                    path = slot.path(index, field)
                    yield Placed(path, start + field.at, field.size, field)
        elif slot.role == "body":
            yield Placed(slot.name, at, size - sum(each.size for each in slots), slot)
        else:
            yield Placed(slot.name, at, slot.size, slot)


def _text(items: Slot, at: int, count: int) -> Placed:
    """Return the text of a list of characters, as one slot."""
    (character,) = items.fields
    said = {"role": "text", "name": items.name, "at": at, "size": count}
    text = {**said, "charset": items.said["text"], "about": character.about, "whole": True}
    return Placed(items.name, at, count, Slot(text, items.byte_order))


def listed(names: Sequence[str], last: str = "and") -> str:
    """Return names as a list in a sentence: `command, length and parameters`."""
    *others, end = names
    return f"{', '.join(others)} {last} {end}" if others else end


def _from_front(at: int, size: int) -> int:
    """Convert a place that may count from the end of a frame into an offset."""
    return at if at >= 0 else size + at
