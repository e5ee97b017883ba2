"""One reading of a recording: its frames, and all that fits them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.guess.fits import checksum_fits, length_fits, likely_checksums
from framegen.guess.framing import MOST_BEFORE, Framing, framed_by_header
from framegen.guess.hidden import hidden_fits
from framegen.guess.ids import IdFit, id_fit
from framegen.guess.parts import Layout, lay_out
from framegen.guess.proven import framed_by_checksum

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.guess.capture import Capture
    from framegen.guess.fits import ChecksumFit
    from framegen.guess.framing import LengthFit
    from framegen.guess.hidden import HiddenFit

# Readings that are looked into, and the share of the best one's bytes that they have to cover.
_READINGS = 4
_NEARLY = 0.5
# So much of it has to be in frames that nothing proves, or else they may be chance.
_MOST_UNPROVEN = 0.75
# So much of a recording has to be in frames, or else it is looked for others.
_MOST = 0.9
# Frames that were chosen by a checksum of a byte are many before they are no chance: there are
# hundreds of methods and ways to cut a line.
_LEAST_BITS = 64
# A header is chosen as well, of a few hundred readings.
_LEAST_BITS_OF_A_HEADER = 40
# So many bytes of a header that stand where no frame begins, in so many places for each frame but
# a few, show that there are other frames.
_HEADER, _MOST_PASSED = 2, 0.3
# Fewer frames show nothing.
_ENOUGH_FRAMES = 3
# Two sizes may agree with a number by chance.
_ENOUGH_SIZES = 3
# The bytes behind a checksum are few.
_MOST_BEHIND = 4


@dataclass(frozen=True)
class Reading:
    """Frames as one reading has them, and what fits them."""

    framing: Framing
    pieces: frozenset[int] = frozenset()

    @property
    def frames(self) -> Sequence[bytes]:
        """The frames that differ."""
        return self.framing.distinct

    @cached_property
    def lengths(self) -> list[LengthFit]:
        """The numbers that may be the length, the likeliest first."""
        fits = length_fits(self.sound)
        # A byte beside one that is always zero is more likely the low one of the two.
        return sorted(fits, key=lambda fit: (-fit.kind.size, fit.at))

    @cached_property
    def checks(self) -> list[ChecksumFit]:
        """What the last bytes may be a checksum of, and how."""
        return checksum_fits(self.frames, min(_MOST_BEHIND, len(self.framing.ended)))

    @cached_property
    def likely_checks(self) -> list[ChecksumFit]:
        """The same, where there are too few frames to believe it."""
        return likely_checksums(self.frames, min(_MOST_BEHIND, len(self.framing.ended)))

    @cached_property
    def hidden(self) -> list[HiddenFit]:
        """The same, with a byte that is not sent, where there is nothing simpler."""
        if self.checks:
            return []
        fits = length_fits(self.frames)
        return hidden_fits(self.frames, {at for fit in fits for at in range(fit.at, fit.end)})

    @property
    def check(self) -> ChecksumFit | HiddenFit | None:
        """The likeliest of those."""
        return self.checks[0] if self.checks else next(iter(self.hidden), None)

    @cached_property
    def length(self) -> LengthFit | None:
        """The likeliest of the lengths, of those that count whole parts."""
        return next((fit for fit in self.lengths if self._layout(fit).counted(fit)), None)

    @cached_property
    def sound(self) -> Sequence[bytes]:
        """The frames that differ, without those that were spoilt on the line."""
        check = self.check
        if check is None:
            return self.frames
        sound = [each for each in self.frames if check.holds(each)]
        if length_fits(sound):
            return sound
        # Where a byte of noise behind a frame is as right as the frame, it is no part of it.
        sizes = {len(each) for each in sound}
        return [
            each
            for each in sound
            if not any(size < len(each) and check.holds(each[:size]) for size in sizes)
        ]

    @cached_property
    def ids(self) -> IdFit:
        """The bytes that say what a frame is."""
        by = tuple(dict.fromkeys(fit.by for fit in self.hidden if fit.by is not None))
        if by:
            return IdFit(by[:1], by[1:])
        tail = self.trailer + (0 if self.check is None else self.check.size)
        end = min(min(map(len, self.sound)) - tail, MOST_BEFORE)
        in_length = {at for fit in self.lengths[:1] for at in range(fit.at, fit.end)}
        candidates = [
            at
            for at in range(end)
            if at not in in_length and len({frame[at] for frame in self.sound}) > 1
        ]
        sound = {*self.sound}
        return id_fit([frame for frame in self.framing.frames if frame in sound], candidates)

    @property
    def trailer(self) -> int:
        """The number of constant bytes that frames end with."""
        if self.checks:
            return self.checks[0].behind
        return 0 if self.hidden else min(_MOST_BEHIND, len(self.framing.ended))

    @cached_property
    def layout(self) -> Layout:
        """The parts of each frame."""
        return self._layout(self.length)

    def _layout(self, length: LengthFit | None) -> Layout:
        return lay_out(self.sound, length, self.check, self.ids.offsets, self.trailer)

    @cached_property
    def weight(self) -> float:
        """How many bits are as they are not by chance: what is constant, and checksums."""
        width = 0 if self.check is None else self.check.width - self.framing.chosen_bits
        return len(self.framing.places) * (self.framing.constant_bits + width)

    @property
    def is_findable(self) -> bool:
        """Whether anything in its frames shows where they begin, or that they are frames."""
        if self.check is not None or self.layout.named("constant"):
            return True
        return self.length is not None and bool(self.layout.named("id"))

    @property
    def is_proven(self) -> bool:
        """Whether a checksum says that these are frames."""
        return self.check is not None

    @property
    def is_enough(self) -> bool:
        """Whether it explains so much that it is no chance, and passes over no other frames."""
        least = _LEAST_BITS if self.framing.chosen_bits else _LEAST_BITS_OF_A_HEADER
        few = _MOST_PASSED * len(self.framing.places) - 1
        if self.weight < least or self._passed_over > max(0, few):
            return False
        share = self.framing.covered / len(self.framing.data)
        return share >= (_NEARLY if self.is_proven else _MOST_UNPROVEN)

    @property
    def _passed_over(self) -> int:
        """How often the beginning of frames stands where none begins in this reading.

        Within frames, a single byte says nothing.
        """
        header = self.framing.begun[:_HEADER]
        if not header:
            return 0
        inside = self.frames if len(header) == _HEADER else ()
        return sum(gap.count(header) for gap in self.framing.gaps) + sum(
            frame.count(header, 1) for frame in inside
        )

    @property
    def length_is_decided(self) -> bool:
        """Whether no other number can be the length, and not by chance."""
        sizes = len({len(frame) for frame in self.sound})
        return len(self.lengths) == 1 and sizes >= _ENOUGH_SIZES

    @property
    def check_is_decided(self) -> bool:
        """Whether no other checksum fits."""
        return len(self.checks) == 1 or len({fit.method for fit in self.hidden}) == 1

    @property
    def beginning_is_decided(self) -> bool:
        """Whether it is known where frames begin, and not only how they follow each other.

        Of constant bytes between frames, any may be the first; unless the recording itself begins
        and ends there, or the pieces of its text do.
        """
        places = self.framing.places
        if places[0][0] == 0 and places[-1][1] == len(self.framing.data):
            return True
        return sum(start in self.pieces for start, _ in places) > len(places) // 2

    def is_like(self, other: Reading) -> bool:
        """Return whether the same frames begin elsewhere here, or are taken together."""
        starts = [start for start, _ in self.framing.places]
        others = {start for start, _ in other.framing.places}
        shifts = {starts[0] - start for start, _ in other.framing.places[:4]}
        return any(
            sum(start - shift in others for start in starts) >= _MOST * len(starts)
            for shift in (0, *shifts)
        )

    def is_stricter(self, other: Reading) -> bool:
        """Return whether frames have more in common here, or a checksum where they had none.

        If they are about as many, those where the recording itself begins and ends come first.
        """
        here, there = self.framing, other.framing
        if len(here.places) < _MOST * len(there.places):
            if here.covered < _MOST * there.covered or here.constant_bits <= there.constant_bits:
                return False
            return self.is_proven and not other.is_proven
        if self.beginning_is_decided != other.beginning_is_decided:
            return self.beginning_is_decided
        return here.constant_weight > there.constant_weight


def readings(capture: Capture) -> list[Reading]:
    """Return the readings that explain most, each another one, the likeliest first."""
    framings = _framings(capture)
    most = framings[0].covered if framings else 0
    pieces = frozenset(capture.starts)
    found: list[Reading] = []
    for framing in framings:
        reading = Reading(framing, pieces)
        alike = next((each for each in found if reading.is_like(each)), None)
        if alike is not None:
            if reading.is_stricter(alike):
                found[found.index(alike)] = reading
        elif framing.covered >= _NEARLY * most:
            found.append(reading)
    # Only the likeliest are looked into: that takes its time.
    found.sort(key=lambda each: (-each.framing.constant_weight, -each.framing.covered))
    chosen = found[:_READINGS]
    chosen += [each for each in found[_READINGS:] if each.framing.is_proven][:_READINGS]
    return sorted(chosen, key=lambda each: -each.weight)


def _framings(capture: Capture) -> list[Framing]:
    """Return ways to cut a recording into frames that are not all the same, the best first."""
    data = capture.data
    framings = framed_by_header(data)
    if not any(map(_is_enough, framings[:_READINGS])):
        framings += framed_by_checksum(data)
    if not any(each.covered >= _MOST * len(data) for each in framings):
        framings.append(Framing(data, tuple(zip(capture.starts, capture.ends, strict=True))))
    framings = [each for each in framings if len(each.distinct) >= _ENOUGH_FRAMES]
    return sorted(framings, key=lambda each: (-each.covered, -len(each.places)))


def _is_enough(framing: Framing) -> bool:
    """Return whether no others need be looked for: noise takes its share of a proven line."""
    if framing.covered >= _MOST * len(framing.data):
        return True
    return framing.covered >= _MOST_UNPROVEN * len(framing.data) and Reading(framing).is_proven
