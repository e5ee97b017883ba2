"""What stands in a recording: messages, frames that a spec does not know, and noise."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from framewire.explain.refusals import (
    BAD_HEADER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    UNKNOWN_COMMAND,
)

from framegen.compile import without_bounds
from framegen.model.codec import values_of
from framegen.model.stream import Event, ReferenceDecoder
from framegen.model.verdict import weigh, weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.audit.recording import Recording, Stretch
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.verdict import Verdict

# What is decoded at once of a long stretch, and the size of noise to which no more is joined.
_WINDOW = 1 << 12
_JOINED = 1 << 14
# How many bytes are weighed once and for all, and how many verdicts on them are kept.
_REMEMBERED, _MOST = 1 << 9, 1 << 14
# For these reasons, what another edition of a spec refused may be a message of this one.
_BY_THE_SPEC = frozenset({UNKNOWN_COMMAND, OUT_OF_RANGE, LENGTH_MISMATCH, COUNT_MISMATCH})


@dataclass(frozen=True)
class Sighting:
    """A message, a frame of unknown id, noise, or what was malformed on purpose.

    `others` are messages of other directions that the frame may be as well. `undocumented` says
    that the frame is that of `message` but for values outside of what the spec allows. `at` is
    where it begins in its stretch.
    """

    data: bytes
    place: str
    stretch: Stretch
    at: int = 0
    message: MessageLayout | None = None
    values: dict[str, Any] = field(default_factory=dict)
    others: tuple[str, ...] = ()
    undocumented: bool = False
    unknown: bool = False
    reason: str = ""

    @property
    def is_certain(self) -> bool:
        """Whether it is one message, and no other."""
        return self.message is not None and not self.others and not self.undocumented


class Reader:
    """A reader of recordings by one spec; `ways` are the directions of bytes without a sender."""

    def __init__(self, model: Model, ways: Sequence[Direction]) -> None:
        self.model = model
        self.ways = ways
        self._unbounded = without_bounds(model)

    def read(self, recording: Recording) -> Iterator[Sighting]:
        """Yield all of a recording, in order."""
        for stretch in recording.stretches:
            if stretch.malformed:
                yield Sighting(stretch.data, stretch.place, stretch, reason=stretch.refused)
                continue
            ways = self._ways(stretch)
            for event in self._events(stretch, ways):
                yield self._sighting(event, stretch, ways)

    def verdict(self, sighting: Sighting) -> Verdict:
        """Judge what begins where noise, or a frame of unknown id, does."""
        behind = sighting.stretch.data[sighting.at : sighting.at + _WINDOW]
        return weigh(self.model, self._ways(sighting.stretch), behind)

    def likely(self, sighting: Sighting) -> str:
        """Return the name of the message that noise began as; empty where it may be several."""
        behind = sighting.stretch.data[sighting.at : sighting.at + _WINDOW]
        verdicts = (weigh(self.model, [way], behind) for way in self._ways(sighting.stretch))
        names = {
            each.likely.name
            for each in verdicts
            if each.likely is not None and each.reason == sighting.reason
        }
        return names.pop() if len(names) == 1 else ""

    def ids(self, sighting: Sighting) -> dict[str, int]:
        """Return the ids that a frame of unknown id has, by the part of the frame."""
        frame = self.model.envelopes[self.verdict(sighting).frame]
        return {
            part.name: part.read_in(sighting.data)
            for part in frame.sent_ids
            if part.is_in(sighting.data)
        }

    @cached_property
    def _alike(self) -> dict[str, set[Direction]]:
        """The directions in which a message of the same ids, or of another frame, may be sent."""
        return {
            name: {
                other.direction
                for other in self.model.messages.values()
                if other.frame is not message.frame or _seen_ids(other) == _seen_ids(message)
            }
            for name, message in self.model.messages.items()
        }

    def _ways(self, stretch: Stretch) -> Sequence[Direction]:
        if stretch.sender is None:
            return self.ways
        return [way for way in self.model.ways if way.sender == stretch.sender]

    def _events(self, stretch: Stretch, ways: Sequence[Direction]) -> Iterator[Event]:
        """Yield what a stretch holds; messages beyond the bounds are those of the other model."""
        if stretch.refused and stretch.refused not in _BY_THE_SPEC:
            yield Event("noise", 0, stretch.data, reason=stretch.refused)
            return
        if stretch.at is not None:
            # A line of a recording is most often one frame.
            models = (self.model, self._unbounded)
            wholes = (weigh_whole(each, ways, stretch.data).message for each in models)
            message = next((each for each in wholes if each is not None), None)
            if message is not None:
                yield Event("message", 0, stretch.data, message)
                return
        noise: list[Event] = []
        for event in _decoded(self.model, ways, stretch.data):
            if event.kind == "noise":
                noise.append(event)
                continue
            yield from self._again(noise, ways)
            noise.clear()
            yield event
        if len(noise) == 1 and noise[0].data == stretch.data and stretch.refused:
            noise = [replace(noise[0], reason=stretch.refused)]
        yield from self._again(noise, ways)

    def _again(self, noise: list[Event], ways: Sequence[Direction]) -> Iterator[Event]:
        """Yield noise, or the messages beyond the bounds that it holds."""
        data = b"".join(event.data for event in noise)
        again = [*_decoded(self._unbounded, ways, data)]
        if any(event.kind == "message" for event in again):
            yield from (replace(event, at=noise[0].at + event.at) for event in again)
        else:
            yield from noise

    def _sighting(self, event: Event, stretch: Stretch, ways: Sequence[Direction]) -> Sighting:
        at, place = event.at, stretch.place_at(event.at)
        message = event.message
        if message is None:
            return Sighting(
                event.data, place, stretch, at, unknown=event.kind == "unknown", reason=event.reason
            )
        values = values_of(message, event.data)
        ours = self.model.messages[message.name]
        others = self._others(ours, ways, event.data) if message is ours else ()
        return Sighting(
            event.data,
            place,
            stretch,
            at,
            message=message,
            values=values,
            others=others,
            undocumented=message is not ours,
        )

    def _others(
        self, message: MessageLayout, ways: Sequence[Direction], data: bytes
    ) -> tuple[str, ...]:
        """Return the messages of other directions that have the same frame."""
        found = (
            weigh_whole(self.model, [way], data).message
            for way in ways
            if way != message.direction and way in self._alike[message.name]
        )
        return tuple(each.name for each in found if each is not None)


def _seen_ids(message: MessageLayout) -> tuple[int, ...]:
    """Return the ids that are in a frame of a message."""
    return message.ids[: len(message.frame.sent_ids)]


@dataclass(frozen=True)
class _Remembering(ReferenceDecoder):
    """The reference decoder, which weighs the same bytes once.

    A header over and over claims what others are made of: a line of nothing else, as a wrong rate
    makes one, would take hours.
    """

    _known: dict[tuple[bytes, bool], Verdict] = field(default_factory=dict)

    def weigh(self, data: bytes, *, quiet: bool = True) -> Verdict:
        """Judge what `data` begins, from memory if that was asked before."""
        if len(data) > _REMEMBERED:
            return super().weigh(data, quiet=quiet)
        verdict = self._known.get((data, quiet))
        if verdict is None:
            if len(self._known) >= _MOST:
                self._known.clear()
            verdict = self._known[data, quiet] = super().weigh(data, quiet=quiet)
        return verdict


def _decoded(model: Model, ways: Sequence[Direction], data: bytes) -> Iterator[Event]:
    """Yield the events of a stretch, after which the line is quiet, a window at a time."""
    noise: Event | None = None
    for event in _in_windows(_Remembering(model, ways), data):
        if event.kind != "noise":
            if noise is not None:
                yield noise
            noise = None
            yield event
        elif noise is None or noise.reason != event.reason or len(noise.data) >= _JOINED:
            if noise is not None:
                yield noise
            noise = event
        else:
            noise = replace(noise, data=noise.data + event.data)
    if noise is not None:
        yield noise


def _in_windows(decoder: ReferenceDecoder, data: bytes) -> Iterator[Event]:
    """Yield the events; noise is in pieces where a window ends."""
    begun = at = 0
    reason = ""
    while begun < len(data):
        at += _WINDOW
        held = data[begun:at]
        events = decoder.decode_so_far(held) if at < len(data) else decoder.decode(held)
        for number, event in enumerate(events):
            goes_on = not number and event.reason == BAD_HEADER and reason
            reason = reason if goes_on else event.reason
            yield replace(event, at=begun + event.at, reason=reason)
            reason = reason if event.kind == "noise" else ""
        if events:
            begun += events[-1].at + len(events[-1].data)
