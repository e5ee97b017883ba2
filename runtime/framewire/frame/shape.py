"""The properties that the fields of a message give to all of its frames, whatever they are."""

from __future__ import annotations

from itertools import count as upwards
from struct import error

from .errors import EncodeError, Reason
from .field import Field
from .lists import List, is_read
from .number import Number, order_of
from .quick_tests import checker, count_test, place_test, range_test

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from typing import Any, TypeAlias

    from .field import Due, Place
    from .floating import Float

    # From where to where it stands, why it would be refused, and what must be there, or what tells
    # where its bytes are wrong, None for nowhere.
    Judged: TypeAlias = "tuple[int, int, Reason, Due]"


# So many sizes are remembered at once.
_REMEMBERED = 1024
# So few places are judged again sooner than it is told which were judged before.
_FEW = 3


class Shape:
    """The fields of a class of messages, in the order of the frame, and the rules for its frames.

    `given` are the numbers that its constructor has to `check`; `items` is the list of a size that
    varies, if there is one; `lengths` are the legal ones, one for each of `counts`. `counter` is
    from where to where the number stands that says how long the list is; None where there is none.
    `parts` are all fields and constants between head and tail. All that can be wrong is told by
    `places`; a frame of legal length, with the right counter, is right where all `tests` hold, and
    `certain` where there are none. `sizes` are those of frames by the bytes of their counter.
    """

    __slots__ = (
        "_counters",
        "_judges_each",
        "_kind",
        "_known",
        "_varying",
        "check",
        "counter",
        "counts",
        "given",
        "items",
        "lengths",
        "optional",
        "parts",
        "sizes",
        "tests",
    )

    def __init__(self, kind: Any, lengths: Sequence[int]) -> None:
        self._kind = kind
        self.lengths = lengths

    def __getattr__(self, name: str) -> Any:
        # Worked out when it is first asked for: few messages of many are ever used.
        if name not in self.__slots__:
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
        self._work_out()
        return getattr(self, name)

    def _work_out(self) -> None:
        kind, lengths = self._kind, self.lengths
        fields: list[Any] = [
            each
            for base in reversed(kind.__mro__)
            for each in vars(base).values()
            if isinstance(each, Field)
        ]
        frame = kind.FRAME
        outside = [part.name for part in (frame.address, frame.counter) if part is not None]
        self.given: list[Number | Float] = [
            each for name in kind.__match_args__ if (each := getattr(kind, name)).plain
        ]
        self.optional: list[Any] = [each for each in fields if each.there is not each]
        # The list or the text whose size varies, if there is one.
        self._varying: Any = next((each for each in fields if each.varies), None)
        self.items = self._varying if isinstance(self._varying, List) else None
        self._counters: Sequence[tuple[Number, int]]
        self._counters = () if self._varying is None else self._varying.counters
        self.counts = range(len(lengths)) if self._varying is None else self._varying.counts
        first = min((number for number, _ in self._counters), key=_at, default=None)
        self.counter = None if first is None else (first.at, first.at + first.struct.size)
        self.sizes = _Sizes(self)
        # Whether something can be wrong in each element of it; where not, the places in frames of
        # each count, of which there are few.
        varying = self._varying
        self._judges_each = varying is not None and any(True for _ in varying.places_of(1))
        self._known: dict[int, list[Judged]] = {}
        body = [each for each in fields if each.name not in outside]
        self.parts: list[Any] = sorted([*body, *kind.CONSTANTS], key=_at)
        self.tests = [*self._tested()]
        self.check = checker(self.given)

    # What a frame must be.

    @property
    def certain(self) -> bool:
        """Whether a frame of legal length, with the right count, is always legal."""
        return not self.tests

    def count_of(self, data: bytes) -> int | None:
        """Return the count that these bytes of the counter mean; None where no frame has it."""
        number, factor = min(self._counters, key=lambda each: each[0].at)
        count, rest = divmod(number.struct.unpack(data)[0], factor)
        return None if rest or count not in self.counts else count

    def size_at(self, count: int) -> int:
        """Return the size of the frames with this count."""
        size: int = self._kind.FRAME.size(self.lengths[self.counts.index(count)])
        return size

    def places(self, count: int, since: int = 0) -> Iterable[Judged]:
        """Return all that can be wrong in the fields of a frame with this count, in its order.

        What ends at `since` or before it is left out.
        """
        if self._judges_each:
            return self._places_at(count, since)
        known = self._known.get(count)
        if known is None:
            if len(self._known) >= _REMEMBERED:
                self._known.clear()
            known = self._known[count] = [*self._places_at(count, 0)]
        return [place for place in known if place[1] > since] if since else known

    def few_places(self, count: int) -> Sequence[Judged] | None:
        """Return all these places if they are so few that they are judged again at no cost."""
        if self._judges_each:
            return None
        places = [*self.places(count)]
        return places if len(places) <= _FEW else None

    def _places_at(self, count: int, since: int) -> Iterator[Judged]:
        until = self._end(count)
        for part in (each.there for each in self.parts):
            if part.at >= until or part is self._varying:
                continue
            for number, factor in self._counters:
                if part is number and number.at + number.struct.size > since:
                    due = number.struct.pack(count * factor)
                    yield number.at, number.at + len(due), Reason.COUNT_MISMATCH, due
            for at, end, wrong in part.places:
                if end > since:
                    yield at, end, Reason.OUT_OF_RANGE, wrong
        if self._varying is not None:
            for at, end, wrong in self._varying.places_of(count, since):
                yield at, end, Reason.OUT_OF_RANGE, wrong

    def _tested(self) -> Iterator[Callable[[bytes], bool]]:
        """Yield what say whether the fields of a frame of legal length are legal.

        Its first count is tested by whoever knows its size.
        """
        places = [*self._fixed()]
        starts = {at for at, _, _ in places}
        numbers = [each for each in self.parts if isinstance(each, Number) and each.at in starts]
        order = order_of(numbers)
        plain = [each for each in numbers if is_read(each, order)]
        if plain:
            yield range_test(plain)
        rest = [place for place in places if place[0] not in {each.at for each in plain}]
        if rest:
            yield place_test(rest, self._kind.FRAME.tail_size)
        varying = self._varying
        if varying is None:
            return
        for number, factor in sorted(self._counters, key=lambda each: each[0].at)[1:]:
            yield count_test(number, factor, varying.at + varying.tail, varying.unit_size)
        yield from varying.tests()

    def _fixed(self) -> Iterator[Place]:
        """Yield what can be wrong at the same place in every frame, save for counts."""
        for part in (each.there for each in self.parts):
            if part is not self._varying:
                yield from part.places

    def out_of_range(self, frame: bytes, at: int) -> str:
        """Return which of the fields of a frame is wrong at an offset, and how; "" if none is."""
        body = frame[: self._size_in(frame) - self._kind.FRAME.tail_size]
        for part in (each.there for each in self.parts):
            for name, base, piece in part.within(body):
                for start, end, due in piece.places:
                    data = body[base + start : base + end]
                    wrong = _wrong(data, due)
                    if wrong is not None and base + start + wrong == at:
                        return f"{name} {piece.explained(data, wrong)}"
        return ""

    def _size_in(self, frame: bytes) -> int:
        """Return the size that a frame says it has; that of its bytes where it does not say so."""
        envelope = self._kind.FRAME
        if envelope.length is None:
            return len(frame)
        size: int = envelope.size(envelope.length.read(frame))
        return size

    @property
    def present(self) -> list[int]:
        """How many of the fields that may be absent are there, in the frames of each count."""
        ends = [self._end(count) for count in self.counts] if self.optional else []
        return [sum(each.at < end for each in self.optional) for end in ends]

    def _end(self, count: int) -> int:
        """Return where the fields of a frame with this count end, if some may be absent."""
        if not self.optional:
            return 1 << 62
        frame, length = self._kind.FRAME, self.lengths[count]
        end: int = frame.size(length) - frame.tail_size
        return end

    # What is given.

    def checked(self, numbers: Sequence[Any]) -> list[int]:
        """Return the numbers of a frame as ints. Raises EncodeError for the first wrong one.

        All its fields are numbers, save that the last one may be a list of them.
        """
        return [
            field.checked(number, path)
            for number, (path, field) in zip(numbers, self._numbers(), strict=False)
        ]

    def _numbers(self) -> Iterator[tuple[str, Number]]:
        """Yield each number of such a frame with its path; those of a list without end."""
        for part in self.parts:
            if isinstance(part, List):
                for position in upwards():
                    yield from part.one(position)
            else:
                yield part.name, part

    def tail(self, *values: Any) -> bytes:
        """Return the bytes of the fields that may be absent. Raises EncodeError for bad ones."""
        data, last = b"", ""
        for field, value in zip(self.optional, values, strict=True):
            if value is None:
                last = last or field.name
                continue
            if last:
                problem = f"it is absent, and {field.name} behind it is not: give both, or neither"
                raise EncodeError(last, None, problem)
            number = field.number
            data += number.struct.pack(number.checked(value, field.name))
        ends = [self._end(count) - self.optional[0].at for count in self.counts]
        if len(data) in ends:
            return data
        return self._no_such_end(len(data), ends)

    def _no_such_end(self, size: int, ends: list[int]) -> bytes:
        """Raise the error for optional fields of so many bytes, with which no frame ends."""
        first = self.optional[0].at
        due = min((end for end in ends if end > size), default=ends[-1])
        absent = [each for each in self.optional if size <= each.at - first < due]
        names = " and ".join(each.name for each in absent)
        problem = f"no frame ends before it: give {names}, or none of them"
        if not absent:
            problem = "no frame goes on with it: leave it out"
        raise EncodeError((absent or self.optional)[0].name, None, problem)


class _Sizes(dict[bytes, int]):
    """The sizes of the frames of a message, by the bytes of its counter; 0 where no frame has it.

    Worked out once for each.
    """

    __slots__ = ("_shape",)

    def __init__(self, shape: Shape) -> None:
        self._shape = shape

    def __missing__(self, counter: bytes) -> int:
        if len(self) >= _REMEMBERED:
            self.clear()
        count = self._shape.count_of(counter)
        self[counter] = size = 0 if count is None else self._shape.size_at(count)
        return size


def _wrong(data: bytes, due: Due) -> int | None:
    """Return the offset of the first byte that is wrong; None if all are right."""
    if isinstance(due, bytes):
        places = enumerate(zip(data, due, strict=False))
        return next((at for at, (byte, right) in places if byte != right), None)
    try:
        return due(data)
    except error:  # it is cut short
        return None


def _at(part: Any) -> int:
    at: int = part.at
    return at
