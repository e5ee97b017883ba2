"""The way through noise: finds the next message, and splits the bytes in front of it into noise.

A frame of unknown command claims as many bytes as its length says. It is shown as one only if its
own bytes prove that no message begins in it: any message is worth more than such a claim.
"""

from __future__ import annotations

from .._frame.errors import Reason
from .._frame.protocol import BODY_AT, HEADER, UNCOUNTED, read_length
from .noise import Noise, UnknownFrame

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .._frame.table import Entry, Table
    from .._frame.verdict import Verdict
    from .decoder import Event

_TOO_SHORT = Reason.TOO_SHORT

# Beginnings of a header, or of a frame, that more bytes may complete, the longest first.
_BEGUN = tuple(HEADER[:size] for size in range(len(HEADER), 0, -1))
# A head of one byte repeated, if the header is such: each byte of a run of it begins another.
_RUN = HEADER[:1] * BODY_AT if not HEADER.strip(HEADER[:1]) else bytes(BODY_AT)
_RUN_CLAIM = read_length(_RUN) + UNCOUNTED
# How much of a run is read at once.
_STRETCH = 256
# A place behind the end of any stream.
_NEVER = 1 << 62


class NoiseLane:
    """The search for messages in noise: it judges each place once, and emits the noise between.

    Places are counted from the beginning of the stream. Each refused header begins a piece of
    noise, save that a run of headers, each a byte after the other, is one piece.
    """

    __slots__ = (
        "_last",
        "_reason",
        "_refused",
        "_table",
        "at",
        "emitted",
        "unknown_frames",
        "wake",
    )

    def __init__(self, table: Table) -> None:
        self._table = table
        # Headers that begin no message and are not emitted yet: the first and the last of some that
        # follow each other byte by byte and are alike, why they begin none, and how many bytes each
        # of them claims as a frame of unknown command.
        self._refused: list[tuple[int, int, Reason, int]] = []
        # Why the current noise is noise, and where the last header was refused.
        self._reason = Reason.BAD_HEADER
        self._last = -1
        # Where the bytes begin that are not emitted yet, where the search goes on, and how many
        # bytes of the stream must be there before it does.
        self.emitted = self.at = self.wake = 0
        self.unknown_frames = 0

    def copy(self) -> NoiseLane:
        """Return a copy in the same state."""
        other = NoiseLane(self._table)
        for name in self.__slots__:
            setattr(other, name, getattr(self, name))
        other._refused = [*self._refused]
        return other

    def begin_anew(self, at: int) -> None:
        """Start a new piece of noise at `at`: everything in front of it has been emitted."""
        self.emitted = at
        self._reason = Reason.BAD_HEADER

    def search(
        self, events: list[Event], data: bytes, base: int, at: int, *, quiet: bool
    ) -> Entry | None:
        """Search on from data[at], and emit the noise in front of the next message.

        `data` begins at the place `base`. Returns the entry of the message, which begins at `at`;
        None if none came, and `emitted`, `at` and `wake` say what is held.
        """
        table, refused = self._table, self._refused
        known = table.verdicts
        while True:
            found = data.find(HEADER, at)
            at = found if found >= 0 else _begun_header(data, at)
            verdict = known.get(data[at : at + BODY_AT])
            if verdict is None:
                entry = table.whole(data, at)
                verdict = table.weigh(data, at) if entry is None else None
                if verdict is not None and verdict.kind is not None:
                    entry = verdict.size, 0, 0, b"", verdict.kind, None
                if verdict is None or entry is not None:
                    if refused:
                        self._cut(events, data, base, at, at, final=True)
                    self._emit_noise(events, data, base, base + at)
                    self.at = base + at
                    return entry
            if verdict.is_open:
                after = self._wait(events, data, base, at, verdict, quiet=quiet)
                if after is None:
                    return None
                if after != at:
                    at = after
                    continue
            last, claim = at, verdict.claim
            if claim == _RUN_CLAIM and data.startswith(_RUN, at):
                last += _run_length(data, at) - BODY_AT
            refused.append((base + at, base + last, verdict.reason, claim))
            at = last + 1

    def _wait(
        self,
        events: list[Event],
        data: bytes,
        base: int,
        at: int,
        verdict: Verdict,
        *,
        quiet: bool,
    ) -> int | None:
        """Wait for the rest of what may begin at data[at], unless the line is quiet.

        Returns None while it waits, otherwise where to go on: at data[at] itself if the header
        there is to be refused.
        """
        # Of an unknown command, only the length of its claim is not known yet.
        weighed = at if verdict.reason is _TOO_SHORT else len(data)
        self._cut(events, data, base, at, weighed, final=quiet)
        if self.emitted > base + at:
            return self.emitted - base
        if quiet and at < len(data):
            return at if data.startswith(HEADER, at) else at + 1
        self.at = self.wake = base + at
        if at < len(data):
            self.wake += verdict.size
        elif self._refused:
            self.wake += BODY_AT
        if self._refused:
            first, _, _, claim = self._refused[0]
            self.wake = min(self.wake, max(first, self.emitted) + claim)
        return None

    def _cut(
        self,
        events: list[Event],
        data: bytes,
        base: int,
        until: int,
        weighed: int,
        *,
        final: bool,
    ) -> None:
        """Emit the noise in front of data[until], up to the first claim that is undecided.

        Claims that end up to data[weighed] are decided by their own bytes, others that end in
        `data` are void. One that would end behind it is undecided, or void as well if this is
        `final`.
        """
        until, weighed = until + base, weighed + base
        horizon = _NEVER if final else len(data) + base
        for number, (first, last, reason, claim) in enumerate(self._refused):
            at = max(first, self.emitted)
            while at <= last:
                end = at + claim
                if claim and end > horizon:
                    del self._refused[:number]
                    self._emit_noise(events, data, base, at)
                    return
                own = claim and end <= weighed
                if own and self._stands_alone(data, at - base, end - base):
                    self._emit_noise(events, data, base, at)
                    self._emit_unknown(events, data, base, end)
                    at = end
                    continue
                # A piece of noise begins, unless it continues a run of headers.
                if reason is not self._reason or at != self._last + 1:
                    self._emit_noise(events, data, base, at)
                    self._reason = reason
                # In a run, this holds for all that end in the same run, or behind data[weighed].
                if claim and at < last:
                    alike = _run_length(data, end - base - 1) if own else horizon - end + 1
                    at = min(last, at + max(alike, 1) - 1)
                else:
                    at = last
                self._last = at
                at += 1
        self._refused.clear()
        self._emit_noise(events, data, base, until)

    def _stands_alone(self, data: bytes, start: int, end: int) -> bool:
        """Return whether data[start:end] proves by itself that no message begins in it.

        That none does is known; a header that only later bytes refused stands near the end.
        """
        if data.endswith(_BEGUN, start + 1, end):
            return False
        at = data.find(HEADER, max(start + 1, end - self._table.reach + 1), end)
        while at >= 0:
            if self._table.weigh(data[at:end]).reason is _TOO_SHORT:
                return False
            at = data.find(HEADER, at + 1, end)
        return True

    def _emit_noise(self, events: list[Event], data: bytes, base: int, until: int) -> None:
        """Emit the bytes in front of the place `until` as noise."""
        if self.emitted < until:
            events.append(Noise(data[self.emitted - base : until - base], self._reason))
            self.emitted = until

    def _emit_unknown(self, events: list[Event], data: bytes, base: int, end: int) -> None:
        """Emit the bytes in front of the place `end` as a frame of unknown command."""
        frame = data[self.emitted - base : end - base]
        events.append(UnknownFrame(frame, Reason.UNKNOWN_COMMAND))
        self.unknown_frames += 1
        self.begin_anew(end)


def _begun_header(data: bytes, at: int) -> int:
    """Return where behind data[at] an incomplete header may begin; the end if none does."""
    for begun in _BEGUN:
        if data.endswith(begun, at):
            return len(data) - len(begun)
    return len(data)


def _run_length(data: bytes, at: int) -> int:
    """Return how often the byte at data[at], the first of a header, is repeated there."""
    stretch = data[at : at + _STRETCH]
    return len(stretch) - len(stretch.lstrip(HEADER[:1]))
