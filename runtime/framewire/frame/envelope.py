"""The envelopes of frames: the parts in front of the fields of a message, and those behind them."""

from __future__ import annotations

from functools import cached_property

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any, Literal, Protocol, TypeAlias

    from .heads import Heads

    # The ids of a message.
    Ids: TypeAlias = Sequence[int]
    # A stretch of a frame, from and to which byte; or bytes that are not sent.
    Covered: TypeAlias = "tuple[int, int | None] | bytes"

    class Method(Protocol):
        """What works a checksum out, at once or along a stream."""

        # A function that returns the checksum of some bytes. What is called like a method, and is
        # none, has no other type that all checkers agree on.
        of: Any

        def running(self) -> Any:
            """Return what works it out along a stream."""


class Part:
    """Bytes of an envelope: their place counts from the end of the frame, if it is below zero."""

    def __init__(self, name: str, size: int) -> None:
        self.name = name
        self.size = size
        self.stand_at(0)

    def stand_at(self, at: int) -> None:
        """Say at which byte of a frame it begins."""
        self.at = at
        self.place: slice = slice(at, at + self.size or None)


class Reserved(Part):
    """Bytes that mean nothing."""


class Constant(Part):
    """Bytes that never change."""

    def __init__(self, name: str, data: bytes) -> None:
        super().__init__(name, len(data))
        self.data = data

    def is_right(self, frame: bytes) -> bool:
        """Return whether a frame has these bytes."""
        return frame[self.place] == self.data


class NumberPart(Part):
    """A whole number without a sign."""

    def __init__(self, name: str, size: int, order: Literal["little", "big"]) -> None:
        super().__init__(name, size)
        self.order: Literal["little", "big"] = order

    def read(self, frame: bytes) -> int:
        """Return the number in a frame."""
        return int.from_bytes(frame[self.place], self.order)

    def write(self, number: int) -> bytes:
        """Return the bytes of a number."""
        return number.to_bytes(self.size, self.order)


class Length(NumberPart):
    """How long the frame is."""


class Id(NumberPart):
    """Which message it is, alone or with others."""


class Counter(NumberPart):
    """A running number."""


class Address(NumberPart):
    """The device: its number, or one with a meaning of its own."""

    def __init__(
        self,
        name: str,
        size: int,
        order: Literal["little", "big"],
        numbers: range,
        named: tuple[int, ...] = (),
    ) -> None:
        super().__init__(name, size, order)
        self.numbers = numbers
        self.named = named

    def holds(self, number: int) -> bool:
        """Return whether there may be such a device."""
        return number in self.numbers or number in self.named

    def is_right(self, frame: bytes) -> bool:
        """Return whether a frame has the number of a device."""
        return self.holds(self.read(frame))

    @property
    def first_bytes(self) -> frozenset[int]:
        """The first bytes of such numbers."""
        named = {self.write(number)[0] for number in self.named}
        if self.order == "little":
            return frozenset(named | {number & 0xFF for number in self.numbers[:0x100]})
        shift = 8 * (self.size - 1)
        first, last = self.numbers[0] >> shift, self.numbers[-1] >> shift
        return frozenset(named | {*range(first, last + 1)})


class Checksum(NumberPart):
    """A number that is worked out from other parts.

    `covers` are stretches of the frame, from and to which byte, and those ids that are not sent, by
    their number among these.
    """

    def __init__(
        self,
        name: str,
        size: int,
        order: Literal["little", "big"],
        method: Method,
        covers: tuple[tuple[int, int | None] | int, ...],
    ) -> None:
        super().__init__(name, size, order)
        self.method = method
        # What works it out at once, from the bytes that it covers.
        self.of: Callable[[bytes], int] = method.of
        self.covers = covers

    def pieces(self, ids: Ids, hidden: Sequence[NumberPart]) -> list[Covered]:
        """Return what it covers in the frames of a message, by the ids of which some are hidden."""
        first = len(ids) - len(hidden)
        return [
            hidden[each].write(ids[first + each]) if isinstance(each, int) else each
            for each in self.covers
        ]

    def prover(self, ids: Ids, hidden: Sequence[NumberPart]) -> Callable[[bytes], bool]:
        """Return a function that says whether a frame of a message has the right one."""
        of, expected, pieces = self.of, self.maker(ids, hidden), self.pieces(ids, hidden)
        at, place, order, from_bytes = self.at, self.place, self.order, int.from_bytes
        if len(pieces) == 1 and isinstance(pieces[0], tuple):
            # By far the most usual, and in the way of every frame.
            covered = slice(*pieces[0])
            if self.size == 1:
                return lambda frame: of(frame[covered]) == frame[at]
            return lambda frame: of(frame[covered]) == from_bytes(frame[place], order)
        return lambda frame: expected(frame) == from_bytes(frame[place], order)

    def maker(self, ids: Ids, hidden: Sequence[NumberPart]) -> Callable[[bytes], int]:
        """Return a function that works it out for a frame of a message."""
        of, pieces = self.of, self.pieces(ids, hidden)
        if len(pieces) == 1 and isinstance(pieces[0], tuple):
            covered = slice(*pieces[0])
            return lambda frame: of(frame[covered])
        if len(pieces) == 2 and isinstance(pieces[0], tuple) and isinstance(pieces[1], bytes):
            # What is not sent stands behind the rest.
            covered, behind = slice(*pieces[0]), pieces[1]
            return lambda frame: of(frame[covered] + behind)
        return lambda frame: of(
            b"".join(each if isinstance(each, bytes) else frame[slice(*each)] for each in pieces)
        )


class Envelope:
    """The parts of a frame around the fields of its message: `head` and `tail`.

    Its length does not count `uncounted` bytes; without a length, it is the size of the frame.
    `hidden` are ids that both ends know, and that no frame holds. `turns` are the names of its
    checksums where one covers another that stands behind it: each comes after those that it covers.
    """

    # Those of all frames of the protocol; they are made of this envelope and the others.
    heads: Heads

    def __init__(
        self,
        name: str,
        head: tuple[Part, ...] = (),
        tail: tuple[Part, ...] = (),
        uncounted: int = 0,
        hidden: tuple[NumberPart, ...] = (),
        turns: tuple[str, ...] = (),
    ) -> None:
        self.name = name
        self.head = head
        self.tail = tail
        self.uncounted = uncounted
        self.hidden = hidden
        at = 0
        for part in head:
            part.stand_at(at)
            at += part.size
        self.body_at = at
        self.tail_size = at = sum(part.size for part in tail)
        for part in tail:
            part.stand_at(-at)
            at -= part.size
        self.least = self.body_at + self.tail_size
        every = (*head, *tail)
        checksums = [part for part in every if isinstance(part, Checksum)]
        if turns:
            checksums.sort(key=lambda part: turns.index(part.name))
        self.checksums = tuple(checksums)
        self.ids = tuple(part for part in head if isinstance(part, Id))
        self.length = next((part for part in head if isinstance(part, Length)), None)
        self.address = next((part for part in every if isinstance(part, Address)), None)
        self.counter = next((part for part in every if isinstance(part, Counter)), None)
        # What may be wrong behind the fields, besides checksums: the constants alone, and all.
        self.ends = tuple(part for part in tail if isinstance(part, Constant))
        self.judged = tuple(part for part in tail if isinstance(part, (Constant, Address)))
        # What may be wrong in a frame of unknown id.
        self.around = tuple(part for part in every if isinstance(part, (Constant, Address)))
        self.seal = _sealer(self)
        """A function that returns a frame, packed with zeros for its checksums, with these."""

    @property
    def proves_unknown(self) -> bool:
        """Whether a frame of an id that is not known proves by itself that it is one."""
        return bool(self.checksums) and self.length is not None and not self.hidden

    @cached_property
    def header(self) -> bytes:
        """The bytes with which every frame begins; b"" where there are none."""
        header = b""
        for part in self.head:
            if not isinstance(part, Constant):
                break
            header += part.data
        return header

    @cached_property
    def first_bytes(self) -> frozenset[int]:
        """The bytes with which a frame may begin."""
        if self.header:
            return frozenset(self.header[:1])
        first = self.head[0] if self.head else None
        return first.first_bytes if isinstance(first, Address) else frozenset(range(0x100))

    def begins(self, data: bytes, at: int) -> bool:
        """Return whether a frame may begin at data[at], as far as its header goes."""
        if self.header:
            return data.startswith(self.header, at)
        return at < len(data) and data[at] in self.first_bytes

    def has_ids(self, data: bytes, ids: Ids) -> bool:
        """Return whether `data` begins as frames with these ids do, as far as these."""
        if not self.begins(data, 0):
            return False
        parts = zip(self.ids, ids, strict=False)
        return all(
            part.at + part.size <= len(data) and part.read(data) == id_ for part, id_ in parts
        )

    def fits(self, frame: bytes) -> bool:
        """Return whether a frame of any id may have this envelope, as far as that can be told."""
        if not self.ids or self.length is None or not self.begins(frame, 0):
            return False
        if len(frame) < self.least or self.size(self.length.read(frame)) != len(frame):
            return False
        if not self.proves_unknown:
            # What is claimed without a proof is not held to how frames end, either.
            return True
        return self.is_around(frame) and self.wrong(frame, ()) is None

    def is_around(self, frame: bytes) -> bool:
        """Return whether a frame of any id has the right constants, and an address that is one."""
        return all(part.is_right(frame) for part in self.around)

    def size(self, length: int) -> int:
        """Return the size of the frames of a length."""
        return length + self.uncounted

    def wrong(self, frame: bytes, ids: Ids) -> Checksum | None:
        """Return the first checksum of a frame that is not right."""
        for part in self.checksums:
            if not part.prover(ids, self.hidden)(frame):
                return part
        return None

    def provers(self, ids: Ids) -> list[Callable[[bytes], bool]]:
        """Return functions that each say whether a checksum of a frame of a message is right."""
        return [part.prover(ids, self.hidden) for part in self.checksums]


def _sealer(envelope: Envelope) -> Callable[[bytes, Ids], bytes]:
    """Return a function that puts its checksums into a frame of a message with these ids."""
    checksums, hidden = envelope.checksums, envelope.hidden
    if [*checksums] == [*envelope.tail] and len(checksums) == 1 and not hidden:
        # By far the most usual, and in the way of every message that is made.
        (part,) = checksums
        make, size, order = part.maker((), ()), part.size, part.order
        if len(part.covers) == 1 and isinstance(part.covers[0], tuple):
            of, covered = part.of, slice(*part.covers[0])
            return lambda frame, _: frame[:-size] + of(frame[covered]).to_bytes(size, order)
        return lambda frame, _: frame[:-size] + make(frame).to_bytes(size, order)

    def sealed(frame: bytes, ids: Ids) -> bytes:
        for part in checksums:
            at = part.at % len(frame)
            right = part.write(part.maker(ids, hidden)(frame))
            frame = frame[:at] + right + frame[at + part.size :]
        return frame

    return sealed


def stretches(pieces: Sequence[Covered], at: int, size: int) -> list[tuple[int, int] | bytes]:
    """Return pieces of the frame that begins at `at` as those of what it stands in."""
    found: list[tuple[int, int] | bytes] = []
    for each in pieces:
        if isinstance(each, bytes):
            found.append(each)
        else:
            start, end = each
            begin = at + start % size if start < 0 else at + start
            found.append((begin, at + size if end is None else at + end + (size if end < 0 else 0)))
    return found
