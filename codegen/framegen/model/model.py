"""The model: everything that follows from a spec, derived once and in one place."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.explain.words import opening

from framegen.model.envelope import derive_envelope
from framegen.model.exchanges import exchanges
from framegen.model.layout import derive_message
from framegen.model.limits import sending_limits
from framegen.model.protocol import protocol_of
from framegen.model.roles import kinds, settle

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from framewire.protocol.protocol import Protocol

    from framegen.language.spec import Spec
    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.limits import SendingLimits
    from framegen.model.roles import Kind, Roles
    from framegen.model.slots import Number


@dataclass(frozen=True, eq=False)
class Candidates:
    """The messages that may come in frames of one envelope, direction by direction.

    `largest` is the size of the largest legal frame of these directions, in whatever envelope.
    """

    frame: Envelope
    messages: Sequence[MessageLayout]
    largest: int

    def with_ids(self, ids: tuple[int, ...]) -> Sequence[MessageLayout]:
        """Return those whose ids begin with these, in the order of the frame."""
        return self._by_ids.get(ids, ())

    def taken(self, part: Number) -> frozenset[int]:
        """Return what they have in a part that is sent, one of their ids."""
        return self._taken[self.frame.ids.index(part)]

    @cached_property
    def _taken(self) -> list[frozenset[int]]:
        parts = range(len(self.frame.ids))
        return [frozenset(message.ids[part] for message in self.messages) for part in parts]

    @cached_property
    def _by_ids(self) -> dict[tuple[int, ...], list[MessageLayout]]:
        sent = len(self.frame.sent_ids)
        found: dict[tuple[int, ...], list[MessageLayout]] = {}
        for message in self.messages:
            for size in range(sent + 1):
                found.setdefault(message.ids[:size], []).append(message)
        return found


@dataclass(frozen=True, eq=False, repr=False)
class Model:
    """Everything that follows from one spec."""

    spec: Spec
    roles: Roles
    envelopes: dict[str, Envelope]
    messages: dict[str, MessageLayout]

    def __repr__(self) -> str:
        # A model is named where it is shown: all of it would be a hundred pages.
        return f"<Model of {self.spec.protocol.name}>"

    @property
    def frame(self) -> Envelope:
        """The envelope of every frame; where there are several, the first."""
        return next(iter(self.envelopes.values()))

    @cached_property
    def lookalikes(self) -> dict[str, Envelope]:
        """The envelope of each look-alike; a look-alike without a frame has the protocol's own."""
        return {
            name: self.frame
            if lookalike.frame is None
            else derive_envelope(lookalike.frame, self.spec.byte_order)
            for name, lookalike in self.spec.lookalikes.items()
        }

    @cached_property
    def ways(self) -> list[Direction]:
        """Every direction: what the client sends, what it receives, and others of messages."""
        return list(dict.fromkeys([*self.roles.directions, *self._sent]))

    @cached_property
    def directions(self) -> list[Direction]:
        """Those directions that messages have."""
        return [way for way in self.ways if way in self._sent]

    @cached_property
    def protocol(self) -> Protocol:
        """The facts of it, for what explains it; a library carries the same."""
        return protocol_of(self)

    def sent(self, direction: Direction) -> Sequence[MessageLayout]:
        """Return the messages of one direction, in the order of the spec."""
        return self._sent.get(direction, ())

    @cached_property
    def _sent(self) -> dict[Direction, list[MessageLayout]]:
        found: dict[Direction, list[MessageLayout]] = {}
        for message in self.messages.values():
            found.setdefault(message.direction, []).append(message)
        return found

    def candidates(self, directions: Sequence[Direction]) -> Sequence[Candidates]:
        """Return what may be on a line, by envelope; every envelope where nothing is sent."""
        key = tuple(directions)
        if key not in self._candidates:
            sent = [message for way in key for message in self.sent(way)]
            names = {message.frame.name for message in sent} or self.envelopes.keys()
            self._candidates[key] = [
                Candidates(
                    frame,
                    [message for message in sent if message.frame is frame],
                    self.largest(key),
                )
                for frame in self.envelopes.values()
                if frame.name in names
            ]
        return self._candidates[key]

    @cached_property
    def _candidates(self) -> dict[tuple[Direction, ...], list[Candidates]]:
        """What may be on each kind of line, worked out once."""
        return {}

    @cached_property
    def first_bytes(self) -> frozenset[int]:
        """The bytes with which a frame may begin."""
        return frozenset[int]().union(*(each.first_bytes for each in self.envelopes.values()))

    def opening(self, directions: Iterable[Direction]) -> str:
        """Return the beginning of a frame of these directions, in words."""
        return opening(self.protocol, map(str, directions))

    def largest(self, directions: Iterable[Direction]) -> int:
        """Return the size of the largest legal frame of these directions; 0 for no messages."""
        return max((self._largest.get(way, 0) for way in directions), default=0)

    @cached_property
    def _largest(self) -> dict[Direction, int]:
        return {way: max(message.largest for message in sent) for way, sent in self._sent.items()}

    def kind(self, name: str) -> Kind:
        """Return the kind of a message: `query`, `command`, `reply` or `report`."""
        return self._kinds[name]

    @cached_property
    def _kinds(self) -> dict[str, Kind]:
        return kinds(self.spec.messages, self.roles)

    @cached_property
    def exchanges(self) -> list[Exchange]:
        """The exchanges of the client, in the order of the spec."""
        return exchanges(self.messages, self.roles)

    @cached_property
    def exchanges_by_request(self) -> dict[str, Exchange]:
        """The exchanges of the client, by the name of their request."""
        return {each.request.name: each for each in self.exchanges}

    @cached_property
    def limits(self) -> SendingLimits | None:
        """The limits of what the client sends, if any field has limits."""
        return sending_limits(each.request for each in self.exchanges)

    @cached_property
    def answers(self) -> dict[str, list[str]]:
        """The requests that each reply answers, by the name of the reply."""
        named = {name: [message.reply or ""] for name, message in self.spec.messages.items()}
        return _turned(named)

    @cached_property
    def reports_on(self) -> dict[str, list[str]]:
        """The messages that each report may follow, by the name of the report."""
        return _turned({name: message.reports for name, message in self.spec.messages.items()})

    @cached_property
    def refuses(self) -> dict[str, list[str]]:
        """The requests that each refusal may answer instead of their reply, by its name."""
        refused = ((name, each.refusal) for name, each in self.spec.messages.items())
        return _turned({name: [refusal] for name, refusal in refused if refusal is not None})


def _turned(named: Mapping[str, Iterable[str]]) -> dict[str, list[str]]:
    """Invert a mapping: by each name that is named, those that name it."""
    found: dict[str, list[str]] = {}
    for name, others in named.items():
        for other in dict.fromkeys(others):
            found.setdefault(other, []).append(name)
    return found


def derive(spec: Spec) -> Model:
    """Derive the model. Needs a spec that keeps the structure rules."""
    envelopes = {
        name: derive_envelope(frame, spec.byte_order, name)
        for name, frame in spec.envelopes.items()
    }
    messages = {
        name: derive_message(spec, envelopes[spec.frame_of(message)], name)
        for name, message in spec.messages.items()
    }
    return Model(spec, settle(spec), envelopes, messages)
