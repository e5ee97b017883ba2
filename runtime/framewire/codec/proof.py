"""The checksums of frames, worked out along a stream."""

from __future__ import annotations

from ..frame.envelope import stretches

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..frame.envelope import Checksum, Envelope


class Proof:
    """What tells wrong checksums of frames: in a stream, whose bytes are summed up once for all.

    The frames may have any of the envelopes. The first byte of the data that it is asked about is
    number `base` of the stream.
    """

    __slots__ = ("_running", "base")

    def __init__(self, envelopes: Sequence[Envelope]) -> None:
        parts = [part for envelope in envelopes for part in envelope.checksums]
        self._running = {part: part.method.running() for part in parts}
        self.base = 0

    def copy(self) -> Proof:
        """Return another one that knows as much."""
        other = Proof(())
        other._running = {part: running.copy() for part, running in self._running.items()}
        other.base = self.base
        return other

    def wrong(
        self, data: bytes, at: int, size: int, frame: Envelope, ids: Sequence[int]
    ) -> Checksum | None:
        """Return the first wrong checksum of the frame at data[at]."""
        for part in frame.checksums:
            pieces = stretches(part.pieces(ids, frame.hidden), at, size)
            right = self._running[part].of(data, self.base, *pieces)
            start = at + part.at % size
            if part.write(right) != data[start : start + part.size]:
                return part
        return None
