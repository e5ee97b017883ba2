"""The parts of a frame, cut where something is known to begin or to end."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.guess.hidden import HiddenFit

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from framegen.guess.fits import ChecksumFit
    from framegen.guess.framing import LengthFit

# So many constant bytes in front are a header, where nothing else is known of them.
_MOST_HEADER = 4
# Numbers of whole bytes that there are, the largest first.
_SIZES = (4, 3, 2, 1)


@dataclass(frozen=True)
class Part:
    """A part of every frame: its name, what it is, and its bytes; the body has `size` 0.

    `at` counts from the end of the frame behind the body.
    """

    name: str
    is_: str
    at: int
    size: int
    data: bytes = b""

    @property
    def end(self) -> int:
        """The offset behind it."""
        return self.at + self.size


@dataclass(frozen=True)
class Layout:
    """The parts of every frame of some reading, in order."""

    parts: tuple[Part, ...]

    @property
    def body(self) -> Part:
        """The part that varies in size."""
        return next(part for part in self.parts if part.is_ == "body")

    @property
    def fixed(self) -> int:
        """The number of bytes outside the body."""
        return sum(part.size for part in self.parts)

    def named(self, is_: str) -> list[Part]:
        """Return the parts of a kind."""
        return [part for part in self.parts if part.is_ == is_]

    def counted(self, length: LengthFit) -> list[list[str]]:
        """Return the parts that a length may count, the likeliest first.

        They are neighbours, and all readings that leave out as many bytes are the same on the wire.
        """
        parts = self.parts
        own = next((at for at, part in enumerate(parts) if part.is_ == "length"), None)
        if own is None:  # it stands behind the shortest frame
            return []
        body = parts.index(self.body)
        runs = [
            (first, last)
            for first in range(body + 1)
            for last in range(body, len(parts))
            if self.fixed - sum(part.size for part in parts[first : last + 1]) == length.uncounted
        ]
        # What stands behind the length is what most count; then what begins with it.
        runs.sort(key=lambda run: ((run[0] <= own) + (run[0] < own), -run[1]))
        return [[part.name for part in parts[first : last + 1]] for first, last in runs]

    def covered(self, check: ChecksumFit | HiddenFit) -> list[str]:
        """Return the parts that a checksum covers, of those that are sent."""
        if isinstance(check, HiddenFit):
            return [part.name for part in self.parts if part.at >= check.first]
        return [
            part.name for part in self.parts if part.at >= check.front or part.at in check.offsets
        ]


def lay_out(
    frames: Sequence[bytes],
    length: LengthFit | None,
    check: ChecksumFit | HiddenFit | None,
    ids: Sequence[int],
    ended: int,
) -> Layout:
    """Cut frames into parts; unknown bytes between others are an address, or a counter."""
    starts = _covered_from(check)
    known: dict[int, tuple[int, str]] = dict.fromkeys(ids, (1, "id"))
    if length is not None:
        known[length.at] = (length.kind.size, "length")
    tail = ended + (0 if check is None else check.size)
    least = min(map(len, frames)) - tail
    constant = [len({frame[at] for frame in frames}) == 1 for at in range(least)]
    body = max([at + size for at, (size, _) in known.items()], default=0)
    body = max([body, _header(constant, known), *(at for at in starts if at <= least)])
    if length is not None:
        # What a length does not count, and is not known, is in front of what it does.
        body = min(max(body, length.uncounted - tail), least)
    parts = [*_front(frames[0], constant, known, sorted({*starts, body}), body)]
    parts.append(Part("body", "body", body, 0))
    if check is not None:
        parts.append(Part("checksum", "checksum", -tail, check.size))
    if ended:
        parts.append(Part("trailer", "constant", -ended, ended, frames[0][-ended:]))
    return Layout(_with_names(parts))


def _header(constant: Sequence[bool], known: Mapping[int, object]) -> int:
    """Return how many constant bytes stand in front of all that is known."""
    end = 0
    while end < len(constant) and constant[end] and end not in known and end < _MOST_HEADER:
        end += 1
    return end


def _covered_from(check: ChecksumFit | HiddenFit | None) -> list[int]:
    """Return the offsets at which what is covered begins or ends."""
    if check is None:
        return []
    if isinstance(check, HiddenFit):
        return [check.first]
    members = [at in check.offsets for at in range(check.front)] + [True]
    return [at for at in range(1, check.front + 1) if members[at] != members[at - 1]]


def _front(
    frame: bytes,
    constant: Sequence[bool],
    known: Mapping[int, tuple[int, str]],
    cuts: Sequence[int],
    body: int,
) -> Iterator[Part]:
    """Yield the parts in front of the body."""
    at = 0
    roles = iter(("address", "counter"))
    while at < body:
        if at in known:
            size, is_ = known[at]
            yield Part(is_, is_, at, size)
            at += size
            continue
        ends = [cut for cut in (*cuts, *known, body) if cut > at]
        end = at + 1
        while end < min(ends) and constant[end] == constant[at]:
            end += 1
        if constant[at]:
            yield Part("header" if at == 0 else "constant", "constant", at, end - at, frame[at:end])
            at = end
            continue
        size = next(size for size in _SIZES if size <= end - at)
        is_ = next(roles, "reserved")
        yield Part(is_, is_, at, size, bytes(size) if is_ == "reserved" else b"")
        at += size


def _with_names(parts: Sequence[Part]) -> tuple[Part, ...]:
    """Give numbers to names that stand more than once."""
    names = [part.name for part in parts]
    seen: dict[str, int] = {}
    named = []
    for part in parts:
        seen[part.name] = seen.get(part.name, 0) + 1
        name = part.name if names.count(part.name) == 1 else f"{part.name}_{seen[part.name]}"
        named.append(Part(name, part.is_, part.at, part.size, part.data))
    return tuple(named)
