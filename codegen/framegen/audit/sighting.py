"""What stands in a recording: messages, frames that a spec does not know, and noise."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from framegen.compile import without_bounds
from framegen.explanation.refusals import (
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    UNKNOWN_COMMAND,
)
from framegen.model.codec import values_of
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh, weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.audit.recording import Recording, Stretch
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.stream import Event
    from framegen.model.verdict import Verdict

# What is decoded at once of a long stretch, and the noise after which none is held any more.
_WINDOW = 1 << 12
_HELD = 1 << 14
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
                yield from self._sightings(event, stretch, ways, has_lines=recording.has_lines)

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

    def _ways(self, stretch: Stretch) -> Sequence[Direction]:
        if stretch.sender is None:
            return self.ways
        return [way for way in self.model.ways if way.sender == stretch.sender]

    def _events(self, stretch: Stretch, ways: Sequence[Direction]) -> Iterator[Event]:
        events = _decoded(self.model, ways, stretch.data)
        if not stretch.refused:
            yield from events
            return
        found = [*events]
        if any(event.kind != "noise" for event in found):
            if stretch.refused in _BY_THE_SPEC:
                yield from found
                return
            found = [replace(found[0], kind="noise", at=0, data=stretch.data, message=None)]
        if len(found) == 1:
            found = [replace(found[0], reason=stretch.refused)]
        yield from found

    def _sightings(
        self, event: Event, stretch: Stretch, ways: Sequence[Direction], *, has_lines: bool
    ) -> Iterator[Sighting]:
        again: list[Event] = []
        if event.kind == "noise" and (not stretch.refused or stretch.refused in _BY_THE_SPEC):
            again = [*_decoded(self._unbounded, ways, event.data)]
        if any(each.kind == "message" for each in again):
            for each in again:
                yield self._sighting(each, event.at, stretch, ways, has_lines=has_lines)
        else:
            yield self._sighting(event, 0, stretch, ways, has_lines=has_lines)

    def _sighting(
        self,
        event: Event,
        before: int,
        stretch: Stretch,
        ways: Sequence[Direction],
        *,
        has_lines: bool,
    ) -> Sighting:
        at = before + event.at
        begun = 0 if has_lines else int(stretch.place.removeprefix("byte "))
        place = stretch.place if has_lines else f"byte {begun + at}"
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
            weigh_whole(self.model, [way], data).message for way in ways if way != message.direction
        )
        return tuple(each.name for each in found if each is not None)


def _decoded(model: Model, ways: Sequence[Direction], data: bytes) -> Iterator[Event]:
    """Yield the events of a stretch, after which the line is quiet, a window at a time."""
    decoder = ReferenceDecoder(model, ways)
    begun = at = 0
    while (at := at + _WINDOW) < len(data):
        held = data[begun:at]
        events = decoder.decode_so_far(held)
        # Noise goes on until a message comes, unless there is too much of it.
        while events and events[-1].kind == "noise" and len(held) < _HELD:
            events.pop()
        for event in events:
            yield replace(event, at=begun + event.at)
        if events:
            begun += events[-1].at + len(events[-1].data)
    for event in decoder.decode(data[begun:]):
        yield replace(event, at=begun + event.at)
