"""The reference stream decoder: what a line says, with whatever is no frame between its messages.

Slow and plain: it weighs every place anew. Every decoder, in whatever language, is held to what it
says, joined: where noise is cut depends on how the bytes came, and its sum does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from framegen.model.verdict import BAD_HEADER, UNKNOWN_COMMAND, weigh

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.verdict import Verdict


@dataclass(frozen=True, slots=True)
class Event:
    """A message, a frame of unknown id, or noise; `reason` says why those two are no message."""

    kind: Literal["message", "unknown", "noise"]
    at: int
    data: bytes
    message: MessageLayout | None = None
    reason: str = ""


@dataclass(frozen=True)
class ReferenceDecoder:
    """Decodes what is heard of `directions` on a line, by weighing every place of it anew.

    Frames of more than `max_frame` bytes are refused by their length; None for any.
    """

    model: Model
    directions: Sequence[Direction]
    max_frame: int | None = None

    def decode(self, data: bytes) -> list[Event]:
        """Say what one stretch of the line held, after which it stays quiet."""
        return self._read(data, quiet=True)

    def follow(self, parts: Iterable[bytes | None]) -> Iterator[Event | None]:
        """Say what a line brings in pieces; None is where it goes quiet, in `parts` and here.

        What is still held at the end is not told.
        """
        stretch = b""
        for part in parts:
            if part is not None:
                stretch += part
                continue
            yield from self.decode(stretch)
            yield None
            stretch = b""
        yield from self.decode_so_far(stretch)

    def decode_so_far(self, data: bytes) -> list[Event]:
        """Say what can be told already while more may come; the rest of `data` is still held.

        A decoder has told at least the messages among these.
        """
        return self._read(data, quiet=False)

    def weigh(self, data: bytes) -> Verdict:
        """Judge what `data` begins."""
        return weigh(self.model, self.directions, data, self.max_frame)

    def _read(self, data: bytes, *, quiet: bool) -> list[Event]:
        events: list[Event] = []
        header = self.model.frame.header
        # Why the noise at hand is none: as long as no header came, because none did.
        reason = BAD_HEADER
        at = 0
        while at < len(data):
            rest = data[at:]
            verdict = self.weigh(rest)
            if verdict.message is not None:
                frame = rest[: verdict.offset]
                events.append(Event("message", at, frame, verdict.message))
                at, reason = at + len(frame), BAD_HEADER
                continue
            if not quiet and self._may_change(rest, verdict):
                break
            claim = verdict.claim
            if 0 < claim <= len(rest) and not self._lives(rest[:claim]):
                events.append(Event("unknown", at, rest[:claim], reason=UNKNOWN_COMMAND))
                at, reason = at + claim, BAD_HEADER
                continue
            if rest.startswith(header):
                reason = verdict.reason
            _tell_noise(events, at, rest[:1], reason)
            at += 1
        return events

    def _may_change(self, data: bytes, verdict: Verdict) -> bool:
        """Tell whether more bytes could change what is to be done with what `data` begins."""
        unfinished = verdict.claim > len(data)
        return verdict.undecided or (unfinished and not self._has_message(data))

    def _lives(self, claimed: bytes) -> bool:
        """Tell whether a frame begins, or may begin, behind the first of the bytes claimed.

        What may, by these bytes alone, is worth more than a claim that nothing proves.
        """
        verdicts = (self.weigh(claimed[at:]) for at in range(1, len(claimed)))
        return any(verdict.message or verdict.undecided for verdict in verdicts)

    def _has_message(self, data: bytes) -> bool:
        return any(self.weigh(data[at:]).message for at in range(1, len(data)))


def _tell_noise(events: list[Event], at: int, data: bytes, reason: str) -> None:
    """Tell noise, as one with what is in front of it if that is noise for the same reason."""
    if events and events[-1].kind == "noise" and events[-1].reason == reason:
        before = events.pop()
        at, data = before.at, before.data + data
    events.append(Event("noise", at, data, reason=reason))
