"""The reference stream decoder: the messages of a stream, and the noise between them.

Slow and plain: it examines every offset anew at which a frame may begin. Every decoder in any
language is tested against it, with neighbouring noise joined: where noise is cut depends on the
chunks, and its sum does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from framewire.explain.refusals import BAD_HEADER, UNKNOWN_COMMAND

from framegen.model.verdict import weigh

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.verdict import Verdict


@dataclass(frozen=True, slots=True)
class Event:
    """A message, a frame of unknown id, or noise; `reason` says why the latter are no message."""

    kind: Literal["message", "unknown", "noise"]
    at: int
    data: bytes
    message: MessageLayout | None = None
    reason: str = ""


@dataclass(frozen=True)
class ReferenceDecoder:
    """A decoder for a line that carries `directions`.

    Frames of more than `max_frame` bytes are refused by their length; None for no bound.
    """

    model: Model
    directions: Sequence[Direction]
    max_frame: int | None = None

    def decode(self, data: bytes) -> list[Event]:
        """Decode one stretch of the line, after which it stays quiet."""
        return self._read(data, quiet=True)

    def follow(self, parts: Iterable[bytes | None]) -> Iterator[Event | None]:
        """Decode chunks; None is where the line goes quiet, in `parts` and in the result.

        What is still held at the end is left out.
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
        """Decode what is certain while more may follow; the rest is still held.

        A decoder has reported at least the messages among these.
        """
        return self._read(data, quiet=False)

    def weigh(self, data: bytes, *, quiet: bool = True) -> Verdict:
        """Judge what `data` begins; of frames that may yet come, only where it is not `quiet`."""
        return weigh(self.model, self.directions, data, self.max_frame, quiet=quiet)

    def _read(self, data: bytes, *, quiet: bool) -> list[Event]:
        events: list[Event] = []
        # Why the noise at hand is none: as long as no header came, because none did.
        reason = BAD_HEADER
        at = 0
        while at < len(data):
            rest = data[at:]
            verdict = self.weigh(rest, quiet=quiet)
            if verdict.message is not None:
                frame = rest[: verdict.offset]
                events.append(Event("message", at, frame, verdict.message))
                at, reason = at + len(frame), BAD_HEADER
                continue
            if not quiet and self._may_change(rest, verdict):
                break
            claim = verdict.claim
            if self._is_unknown(rest, verdict):
                events.append(Event("unknown", at, rest[:claim], reason=UNKNOWN_COMMAND))
                at, reason = at + claim, BAD_HEADER
                continue
            if self._is_header(rest):
                reason = verdict.reason
            end = self._next_begun(data, at + 1)
            _emit_noise(events, at, data[at:end], reason)
            at = end
        return events

    def _may_change(self, data: bytes, verdict: Verdict) -> bool:
        """Tell whether more bytes could change the verdict on what `data` begins."""
        unfinished = verdict.claim > len(data)
        if verdict.provable:
            return unfinished
        return verdict.undecided or (unfinished and not self._has_frame(data))

    def _is_unknown(self, data: bytes, verdict: Verdict) -> bool:
        """Tell whether a frame of unknown id begins: one that is proven, or that may be one."""
        if verdict.provable:
            return verdict.proven
        return 0 < verdict.claim <= len(data) and not self._lives(data[: verdict.claim])

    def _is_header(self, data: bytes) -> bool:
        """Tell whether a frame may begin here as far as its header goes."""
        largest = self.max_frame
        frames = (each.frame for each in self.model.candidates(self.directions))
        if largest is not None:
            frames = (frame for frame in frames if frame.least <= largest)
        return any(frame.begins(data) for frame in frames)

    def _lives(self, claimed: bytes) -> bool:
        """Tell whether a frame begins, or may begin, behind the first claimed byte.

        A possible frame takes precedence over a claim that nothing proves.
        """
        return any(
            verdict.message or verdict.proven or verdict.waits(len(begun))
            for begun, verdict in self._weighed(claimed)
        )

    def _has_frame(self, data: bytes) -> bool:
        """Tell whether a certain frame begins behind the first byte."""
        verdicts = (verdict for _, verdict in self._weighed(data))
        return any(verdict.message or verdict.proven for verdict in verdicts)

    def _weighed(self, data: bytes) -> Iterator[tuple[bytes, Verdict]]:
        """Yield what begins behind the first byte as a header does, with the verdict on it."""
        return ((begun, self.weigh(begun)) for begun in self._begun(data))

    def _begun(self, data: bytes) -> Iterator[bytes]:
        """Yield what begins behind the first byte as a header does."""
        at = self._next_begun(data, 1)
        while at < len(data):
            yield data[at:]
            at = self._next_begun(data, at + 1)

    def _next_begun(self, data: bytes, at: int) -> int:
        """Return where the next byte stands with which a header begins, and so a frame may."""
        while at < len(data) and data[at] not in self.model.first_bytes:
            at += 1
        return at


def _emit_noise(events: list[Event], at: int, data: bytes, reason: str) -> None:
    """Add noise, joined with noise of the same reason in front of it."""
    if events and events[-1].kind == "noise" and events[-1].reason == reason:
        before = events.pop()
        at, data = before.at, before.data + data
    events.append(Event("noise", at, data, reason=reason))
