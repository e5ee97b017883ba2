"""The way through noise: finds the next message, and splits the bytes in front of it into noise.

A frame of unknown command claims as many bytes as its length says. It is shown as one only if its
own bytes prove that no message begins in it: any message is worth more than such a claim.
"""

from __future__ import annotations

from ..frame.errors import Reason
from .noise import Noise
from .proof import Proof

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from ..frame.message import Message
    from ..frame.table import Table
    from ..frame.verdict import Verdict
    from .noise import UnknownFrame

_TOO_SHORT = Reason.TOO_SHORT

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
        "_proof",
        "_reason",
        "_refused",
        "_since",
        "_table",
        "_unknown_frame",
        "at",
        "emitted",
        "summed",
        "unknown_frames",
        "wake",
    )

    def __init__(self, table: Table, unknown_frame: type[UnknownFrame]) -> None:
        self._table = table
        self._unknown_frame = unknown_frame
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
        # What works out checksums along the stream, and up to where one was worked out in vain.
        self._proof = Proof(table.heads.envelopes)
        self.summed = 0
        # How much of the frame at `at` has been judged already.
        self._since = 0

    def copy(self) -> NoiseLane:
        """Return a copy in the same state."""
        other = NoiseLane(self._table, self._unknown_frame)
        for name in self.__slots__:
            setattr(other, name, getattr(self, name))
        other._refused = [*self._refused]
        other._proof = self._proof.copy()
        return other

    def begin_anew(self, at: int) -> None:
        """Start a new piece of noise at `at`: everything in front of it has been emitted."""
        self.emitted = at
        self._reason = Reason.BAD_HEADER

    def search(
        self, events: list[Message | Noise], data: bytes, base: int, at: int, *, quiet: bool
    ) -> tuple[int, type[Message]] | None:
        """Search on from data[at], and emit the noise in front of the next message.

        `data` begins at the place `base`. Returns the size and the class of the message, which
        begins at `at`; None if none came, and `emitted`, `at` and `wake` say what is held.
        """
        table, refused = self._table, self._refused
        known, header, head_size = table.verdicts, table.header, table.head_size
        self._proof.base = base
        while True:
            begun = data.find(header, at) if header else -1
            at = begun if begun >= 0 else table.next_begun(data, at)
            head = data[at : at + head_size]
            verdict = known.get(head)
            if verdict is None:
                found = table.whole(head, data, at)
                if found is not None:
                    self._end(events, data, base, at)
                    return found
                since = self._since if base + at == self.at else 0
                verdict = table.weigh(data, at, self._proof.wrong, since, quiet=quiet)
                if verdict.kind is not None:
                    self._end(events, data, base, at)
                    return verdict.size, verdict.kind
                if verdict.proven and not verdict.is_open:
                    self._end(events, data, base, at)
                    at += verdict.size
                    self._emit_unknown(events, data, base, base + at)
                    continue
            if verdict.is_open:
                after = self._wait(events, data, base, at, verdict, quiet=quiet)
                if after is None:
                    return None
                if after != at:
                    at = after
                    continue
            last = self._run_end(data, at) if verdict.claim == table.run_claim else at
            if header or table.begins(data, at):
                refused.append((base + at, base + last, verdict.reason, verdict.claim))
            at = last + 1

    def _end(self, events: list[Message | Noise], data: bytes, base: int, at: int) -> None:
        """Emit the noise in front of data[at], where a frame begins."""
        if self._refused:
            self._cut(events, data, base, at, at, final=True)
        self.at = base + at
        self._emit_noise(events, data, base, self.at)

    def _run_end(self, data: bytes, at: int) -> int:
        """Return where the last head begins of the run of a header's byte at data[at]."""
        run = self._table.run
        return at + _run_length(data, at, run) - len(run) if data.startswith(run, at) else at

    def _wait(
        self,
        events: list[Message | Noise],
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
        weighed = at if verdict.reason is _TOO_SHORT or verdict.proven else len(data)
        self._cut(events, data, base, at, weighed, final=quiet)
        if self.emitted > base + at:
            return self.emitted - base
        if quiet and at < len(data):
            return at if self._table.begins(data, at) else at + 1
        self.at, self._since = base + at, len(data) - at
        self.wake = self.at + verdict.size
        if self._refused:
            first, _, _, claim = self._refused[0]
            # Where nothing has begun, only a whole frame decides, or the end of a claim.
            size = self._table.heads.least if at == len(data) else verdict.size
            self.wake = min(self.at + size, max(first, self.emitted) + claim)
        return None

    def _cut(
        self,
        events: list[Message | Noise],
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
            at = first
            if first < self.emitted:
                # A frame of unknown command has taken what is in front of `emitted`.
                at = min(self.emitted, last + 1)
            while at <= last:
                end = at + claim
                if claim and end > horizon:
                    del self._refused[:number]
                    self._emit_noise(events, data, base, at)
                    return
                own = claim and end <= weighed
                if own and self.stands_alone(data, at - base, end - base):
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
                    run = self._table.run
                    alike = _run_length(data, end - base - 1, run) if own else horizon - end + 1
                    at = min(last, at + max(alike, 1) - 1)
                else:
                    at = last
                self._last = at
                at += 1
        self._refused.clear()
        self._emit_noise(events, data, base, until)

    def stands_alone(self, data: bytes, start: int, end: int) -> bool:
        """Return whether data[start:end] proves by itself that no message begins in it.

        That none does is known; a header that only later bytes refused stands near the end.
        """
        table, header = self._table, self._table.header
        if data.endswith(table.begun, start + 1, end):
            return False
        next_begun = table.heads.next_begun
        held = data[max(start + 1, end - table.reach + 1) : end]
        at = held.find(header) if header else next_begun(held, 0)
        while 0 <= at < len(held):
            verdict = table.weigh(held, at)
            if verdict.reason is _TOO_SHORT or verdict.proven:
                return False
            at = held.find(header, at + 1) if header else next_begun(held, at + 1)
        return True

    def _emit_noise(
        self, events: list[Message | Noise], data: bytes, base: int, until: int
    ) -> None:
        """Emit the bytes in front of the place `until` as noise."""
        if self.emitted < until:
            events.append(Noise(data[self.emitted - base : until - base], self._reason))
            self.emitted = until

    def _emit_unknown(
        self, events: list[Message | Noise], data: bytes, base: int, end: int
    ) -> None:
        """Emit the bytes in front of the place `end` as a frame of unknown command."""
        frame = data[self.emitted - base : end - base]
        events.append(self._unknown_frame(frame, Reason.UNKNOWN_COMMAND))
        self.unknown_frames += 1
        self.begin_anew(end)


def _run_length(data: bytes, at: int, run: bytes) -> int:
    """Return how often the byte of a run is repeated at data[at]."""
    stretch = data[at : at + _STRETCH]
    return len(stretch) - len(stretch.lstrip(run))
