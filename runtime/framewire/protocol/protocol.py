"""A protocol: its envelopes and messages, its line and ends, and what is written of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

from .envelope import Envelope
from .message import Message
from .words import Endpoint, Erratum, Example, Link, Note, Reserved, Source, Unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence


@dataclass(frozen=True, kw_only=True)
class Lookalike:
    """Another protocol that is easily taken for this one, with the meanings of ids there.

    Without an envelope, its frames have the first of the protocol.
    """

    title: str
    about: str
    cite: str
    envelope: Envelope | None = field(default=None, metadata={"key": "frame"})
    commands: Mapping[int, str]
    examples: tuple[Example, ...]


@dataclass(frozen=True, kw_only=True)
class Protocol:
    """All facts of a protocol. `directions` are those of messages, the client's first.

    `members` are the names that a library has for directions. `authority` is the source that
    decides, and `byte_order` that of numbers which do not say their own.
    """

    title: str
    summary: str
    description: str
    notes: tuple[Note, ...] = ()
    endpoints: Mapping[str, Endpoint]
    authority: str
    byte_order: str
    link: Link
    directions: tuple[str, ...]
    sources: Mapping[str, Source]
    envelopes: Mapping[str, Envelope]
    messages: Mapping[str, Message]
    reserved: tuple[Reserved, ...]
    lookalikes: Mapping[str, Lookalike]
    errata: tuple[Erratum, ...]
    unknowns: tuple[Unknown, ...]
    members: Mapping[str, str] = field(default_factory=dict)

    @cached_property
    def frame(self) -> Envelope:
        """The envelope of every frame; where there are several, the first."""
        return next(iter(self.envelopes.values()))

    @cached_property
    def classes(self) -> dict[str, str]:
        """The class of each message: some of their names are taken in Python."""
        return {name: each.class_name or name for name, each in self.messages.items()}

    def frame_of(self, lookalike: Lookalike) -> Envelope:
        """Return the envelope of the frames of a look-alike."""
        return lookalike.envelope or self.frame

    @cached_property
    def _sent(self) -> dict[tuple[str, str], list[Message]]:
        found: dict[tuple[str, str], list[Message]] = {}
        for message in self.messages.values():
            found.setdefault((message.direction, message.envelope.name), []).append(message)
        return found

    def sent(self, direction: str, frame: Envelope) -> Sequence[Message]:
        """Return the messages of a direction in frames of an envelope."""
        return self._sent.get((direction, frame.name), ())

    def largest(self, directions: Iterable[str]) -> int:
        """Return the size of the largest legal frame of these directions; 0 for no messages."""
        chosen = set(directions)
        sizes = (each.largest for each in self.messages.values() if each.direction in chosen)
        return max(sizes, default=0)

    def source(self, cite: str) -> tuple[str, str]:
        """Return the source of a citation by its title, and its kind where it does not decide."""
        name, _, place = cite.partition(", ")
        source = self.sources.get(name, Source(name, ""))
        marked = name != self.authority
        return ", ".join(filter(None, (source.title, place))), source.kind if marked else ""
