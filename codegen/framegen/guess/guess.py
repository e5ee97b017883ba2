"""The guess: the likeliest reading of a recording, and how far it is the only one."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.guess.hidden import HiddenFit
from framegen.guess.reading import readings

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.guess.capture import Capture
    from framegen.guess.fits import ChecksumFit
    from framegen.guess.framing import LengthFit
    from framegen.guess.reading import Reading

# Another reading with so many of the bits that agree is no worse.
_AS_GOOD = 0.67

# So many checksums that may be chance are named.
_NAMED = 4


@dataclass(frozen=True)
class Conclusion:
    """What was found about a part of the protocol, and what fits equally, if it is undecided."""

    about: str
    says: str
    is_decided: bool
    others: tuple[str, ...] = ()


@dataclass(frozen=True)
class Guess:
    """The likeliest reading of a recording, and those that explain it no worse."""

    capture: Capture
    reading: Reading
    rivals: tuple[Reading, ...]

    @cached_property
    def conclusions(self) -> list[Conclusion]:
        """What was found, from the frame as a whole to its parts."""
        frames = self._frames()
        found = [frames, self._header(), self._length(), self._checksum(), self._ids()]
        if frames.is_decided:
            return found
        # What frames are is what all the rest is about.
        return [Conclusion(each.about, each.says, False, each.others) for each in found]

    def conclusion(self, about: str) -> Conclusion:
        """Return what was found about one thing."""
        return next(each for each in self.conclusions if each.about == about)

    def _frames(self) -> Conclusion:
        says = _frames(self.reading)
        is_decided = self.reading.is_enough and not self.rivals
        return Conclusion("frames", says, is_decided, tuple(map(_frames, self.rivals)))

    def _header(self) -> Conclusion:
        constants = [part for part in self.reading.layout.named("constant") if part.name]
        front = [part for part in constants if part.at == 0]
        behind = [part for part in constants if part.at < 0]
        says = " and ".join(
            [
                *(f"each begins {part.data.hex(' ').upper()}" for part in front),
                *(f"each ends {part.data.hex(' ').upper()}" for part in behind),
            ]
        )
        if not says:
            return Conclusion("constants", "nothing is the same in each", is_decided=True)
        if self.reading.beginning_is_decided:
            return Conclusion("constants", says, is_decided=True)
        other = "the first of these bytes may as well end the frame before"
        return Conclusion("constants", says, is_decided=False, others=(other,))

    def _length(self) -> Conclusion:
        sizes = {len(frame) for frame in self.reading.sound}
        if len(sizes) == 1:
            says = f"each has {pluralize(sizes.pop(), 'byte')}, so that no number shows as a length"
            return Conclusion("length", says, is_decided=False)
        if self.reading.length is None:
            says = "no number says how long a frame is: that follows from what it says"
            return Conclusion("length", says, is_decided=False)
        first, *others = map(_length, self.reading.lengths)
        return Conclusion("length", first, self.reading.length_is_decided, tuple(others))

    def _checksum(self) -> Conclusion:
        fits: Sequence[ChecksumFit | HiddenFit] = self.reading.checks or self.reading.hidden
        if not fits:
            return self._likely_checksum()
        first, *others = dict.fromkeys(map(_checksum, fits))
        return Conclusion("checksum", first, self.reading.check_is_decided, tuple(others))

    def _likely_checksum(self) -> Conclusion:
        fits = self.reading.likely_checks
        if not fits:
            says = "no method of the catalogue is right over any bytes that were tried"
            return Conclusion("checksum", says, is_decided=False)
        count = pluralize(len(self.reading.frames), "different frame")
        says = f"{count} are too few to tell whether there is one"
        right = tuple(f"right for all: {each}" for each in map(_checksum, fits[:_NAMED]))
        more = (f"and {len(fits) - _NAMED} more",) if len(fits) > _NAMED else ()
        return Conclusion("checksum", says, is_decided=False, others=right + more)

    def _ids(self) -> Conclusion:
        ids = self.reading.ids
        if not ids.offsets:
            maybe = (f"byte {at} may be one" for at in ids.rivals)
            says = "the sizes of frames go with no byte that could be an id"
            return Conclusion("ids", says, is_decided=False, others=tuple(maybe))
        says = f"{_bytes(ids.offsets)} {'says' if len(ids.offsets) == 1 else 'say'} what a frame is"
        others = tuple(f"byte {at} alone may be an id, or none" for at in ids.rivals)
        return Conclusion("ids", says, ids.is_decided, others)


def guess(capture: Capture) -> Guess | None:
    """Guess the protocol of a recording; None where nothing shows where frames begin."""
    found = [reading for reading in readings(capture) if reading.is_findable]
    if not found:
        return None
    best, *others = found
    return Guess(capture, best, tuple(_as_good(best, others)))


def _as_good(best: Reading, others: Sequence[Reading]) -> Iterator[Reading]:
    for other in others:
        if other.is_proven >= best.is_proven and other.weight >= _AS_GOOD * best.weight:
            yield other


def _frames(reading: Reading) -> str:
    sizes = sorted({len(frame) for frame in reading.sound})
    least, most = sizes[0], sizes[-1]
    span = pluralize(least, "byte") if least == most else f"{least} to {most} bytes"
    frames = pluralize(len(reading.framing.places), "frame")
    begun = reading.framing.begun[:4].hex(" ").upper() if reading.beginning_is_decided else ""
    return f"{frames} of {span}" + (f" that begin {begun}" if begun else "")


def _length(fit: LengthFit) -> str:
    at = f"byte {fit.at}" if fit.kind.size == 1 else f"bytes {fit.at} and {fit.at + 1}"
    order = "" if fit.kind.size == 1 else f", {fit.kind.order}-endian,"
    less = f", less {fit.uncounted}" if fit.uncounted else ""
    says = "is" if fit.kind.size == 1 else "are"
    return f"{at}{order} {says} the size of the frame{less}"


def _checksum(fit: ChecksumFit | HiddenFit) -> str:
    size = "byte" if fit.size == 1 else f"{fit.size} bytes"
    order = f", {fit.order}-endian" if fit.size > 1 else ""
    if isinstance(fit, HiddenFit):
        where, over = f"the last {size}", f"from byte {fit.first} on, and a byte that is not sent"
        follows = "" if fit.by is None else f" and follows from byte {fit.by}"
        return f"{where}: `{fit.method}`{order}, of all {over}{follows}"
    behind = f" before the last {fit.behind}" if fit.behind else ""
    if fit.is_one_piece:
        over = f"all from byte {fit.front - len(fit.offsets)} on"
    else:
        over = (
            f"{_bytes(fit.offsets)} and all from byte {fit.front} on"
            if fit.offsets
            else (f"all from byte {fit.front} on")
        )
    return f"the last {size}{behind}: `{fit.method}`{order}, of {over}"


def _bytes(offsets: Sequence[int]) -> str:
    *most, last = map(str, offsets)
    return f"bytes {', '.join(most)} and {last}" if most else f"byte {last}"
