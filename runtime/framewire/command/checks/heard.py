"""What came over a line in pieces, each with its time: messages, and runs of noise between them."""

from __future__ import annotations

from bisect import bisect_left
from itertools import accumulate, groupby, pairwise

from ...codec.event_bytes import bytes_of
from ...codec.noise import Noise

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.message import Message

    # Bytes, and events, each with the time at which they had come.
    Pieces = list[tuple[float, bytes]]
    TimedEvent = tuple[float, Message | Noise]

PAUSE = 0.06
"""A silence, in seconds, that ends what comes: longer than USB adapters keep bytes back for."""


class Heard:
    """What came in pieces; the bytes in `left_out` are skipped.

    A message may have pauses in it, noise has none: what came after a silence is judged by itself.
    `runs` has the noise that came in one go, each as its events.
    """

    def __init__(self, codec: ProtocolCodec, pieces: Pieces, left_out: range = range(0)) -> None:
        self._codec = codec
        self._times = [at for at, _ in pieces]
        self._ends = [*accumulate(len(piece) for _, piece in pieces)]
        self._left_out = left_out
        data = b"".join(piece for _, piece in pieces)
        self._data = data[: left_out.start] + data[left_out.stop :]
        self.events: list[TimedEvent] = []
        self.runs: list[list[Noise]] = []
        self._decode()

    @property
    def messages(self) -> list[Message]:
        """The messages that came."""
        return [event for _, event in self.events if not isinstance(event, Noise)]

    def _decode(self) -> None:
        end = 0
        # All at once, so that consecutive noise is one piece.
        for is_noise, some in groupby(
            self._events_in(self._data), lambda each: isinstance(each, Noise)
        ):
            start, events = end, [*some]
            end += sum(len(bytes_of(each)) for each in events)
            if not is_noise:
                self._add(start, events)
                continue
            cuts = [start, *(cut for cut in self._silences() if start < cut < end), end]
            for first, last in pairwise(cuts):
                apart = events if len(cuts) == 2 else self._events_in(self._data[first:last])
                self._add(first, apart)
                run = [each for each in apart if isinstance(each, Noise)]
                if run:
                    self.runs.append(run)

    def _add(self, at: int, events: Sequence[Message | Noise]) -> None:
        for event in events:
            at += len(bytes_of(event))
            self.events.append((self._time_of(at), event))

    def _time_of(self, end: int) -> float:
        """Return when the bytes up to a place were complete."""
        at = end + len(self._left_out) * (end > self._left_out.start)
        return self._times[bisect_left(self._ends, at)]

    def _silences(self) -> Iterator[int]:
        """Yield the places in front of which the line was silent."""
        for (before, after), end in zip(pairwise(self._times), self._ends, strict=False):
            if after - before >= PAUSE:
                skipped = range(self._left_out.start, min(end, self._left_out.stop))
                yield end - len(skipped)

    def _events_in(self, data: bytes) -> list[Message | Noise]:
        decoder = self._codec.decoder(self._codec.received)
        return [*decoder.feed(data), *decoder.flush()]
