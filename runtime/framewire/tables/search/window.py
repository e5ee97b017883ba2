"""Find all frames and all noise of a stream, many at once: exactly what its stream decoder finds.

The stream is examined in windows. Each header with enough bytes behind it is judged by itself; of
the frames that are legal, each begins behind the one before. What lies between them is noise.
"""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

import numpy as np

from ...recording.layout import REASON_NUMBERS, layouts_of
from ...recording.reader import read
from ..by_entry import events_by_entry
from ..events import UNKNOWN_SENDER, Events, Frames, NoiseRuns
from ..places import find_all
from .chain import Chain, chained, no_chain
from .fields import NO_KIND
from .legal import UNKNOWN_COMMAND, UNKNOWN_KIND
from .noise_pieces import noise_pieces
from .unknown import Claims

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from numpy.typing import NDArray

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ..events import Bytes, Numbers
    from .legal import LegalFrames

_BAD_HEADER = REASON_NUMBERS["BAD_HEADER"]
_NOTHING = np.empty(0, np.int64)
# What the end of a stream holds is one stretch.
_ALL = 1 << 31


def search(
    codec: ProtocolCodec, blocks: Iterable[Bytes], direction: Direction | None, legal: LegalFrames
) -> Iterator[Events]:
    """Yield what a stream holds, which comes in blocks; after the last, the line is quiet.

    `legal` are the frames on a line that carries `direction`.
    """
    window = _Window(codec, direction, legal)
    for block in blocks:
        yield window.add(block)
    yield from window.end()


class _Window:
    """The bytes of a stream that are not decided yet, and what was in front of them."""

    def __init__(
        self, codec: ProtocolCodec, direction: Direction | None, legal: LegalFrames
    ) -> None:
        layouts = layouts_of(codec)
        self._codec = codec
        self._direction = direction
        self._sender = UNKNOWN_SENDER if direction is None else layouts.directions.index(direction)
        # Who sends each message.
        self._senders = np.array([each.direction for each in layouts.every], np.int8)
        self._legal = legal
        self._header = self._legal.envelope.header
        self._claims = Claims(codec, direction, self._header)
        self._data: Bytes = np.empty(0, np.uint8)
        # Where they begin in the capture; and why noise is noise that goes on there.
        self._offset = 0
        self._reason = _BAD_HEADER

    def add(self, block: Bytes) -> Events:
        """Take in bytes, and return the events that are certain now."""
        data = self._data = np.concatenate((self._data, block))
        # The largest frame may begin there, and another in its last byte.
        until = len(data) - 2 * self._legal.largest
        if until <= 0:
            return self._events(no_chain(), _NOTHING, _NOTHING, 0)
        places = find_all(data[: until + self._legal.largest], self._header)
        judged = self._legal.judge(data, places)
        chain = chained(places, judged)
        if not self._legal.proves_unknown:
            chain = self._claims.put_between(chain, data, places, judged)
        chain = chain.chosen(slice(np.searchsorted(chain.start, until)))
        refused = np.flatnonzero(judged.kind == NO_KIND)
        return self._events(chain, places[refused], judged.reason[refused], until)

    def end(self) -> Iterator[Events]:
        """Return the events of the rest, behind which nothing comes."""
        data = self._data
        headers = find_all(data, self._header)
        rest = int(headers[0]) if len(headers) else len(data)
        yield self._events(no_chain(), _NOTHING, _NOTHING, rest)
        entries = read(self._codec, io.BytesIO(self._data.tobytes()), "raw", self._direction)
        for events in events_by_entry(self._codec, entries, _ALL):
            yield events.moved(self._offset)

    def _events(self, chain: Chain, refused: Numbers, reasons: NDArray[Any], until: int) -> Events:
        """Return the events in front of data[until], and forget their bytes."""
        data = self._data
        done = max(until, int(chain.end[-1]) if len(chain.start) else 0)
        begins, ends, reason = noise_pieces(
            chain, done, refused, reasons, first=self._reason, usual=_BAD_HEADER
        )
        goes_on = len(ends) and ends[-1] == done
        if done:
            self._reason = int(reason[-1]) if goes_on else _BAD_HEADER
        is_unknown = chain.kind == UNKNOWN_KIND
        unknown = chain.chosen(is_unknown)
        if len(unknown.start):
            chain = chain.chosen(~is_unknown)
        runs = self._runs(unknown, begins, ends, reason)
        events = Events(self._frames(chain), runs, self._offset + done)
        self._data = data[done:]
        self._offset += done
        return events

    def _frames(self, chain: Chain) -> Frames:
        sender = self._senders.take(chain.kind)
        if self._direction is None:
            sender[chain.either] = UNKNOWN_SENDER
        return Frames(
            data=self._data,
            start=chain.start,
            offset=chain.start + self._offset,
            size=(chain.end - chain.start).astype(np.uint32),
            kind=chain.kind,
            direction=sender,
            time=None,
            clock=None,
        )

    def _runs(self, unknown: Chain, begins: Numbers, ends: Numbers, reason: Numbers) -> NoiseRuns:
        """Return noise and unknown frames, in order."""
        count = len(begins) + len(unknown.start)
        claims = zip(unknown.start.tolist(), unknown.end.tolist(), strict=True)
        data: list[bytes | None] = [None] * len(begins)
        data += [self._data[start:end].tobytes() for start, end in claims]
        start = np.concatenate((begins, unknown.start))
        size = np.concatenate((ends - begins, unknown.end - unknown.start))
        reasons = np.concatenate((reason, np.full(len(unknown.start), UNKNOWN_COMMAND)))
        order = np.argsort(start, kind="stable")
        return NoiseRuns(
            offset=start[order] + self._offset,
            size=size[order],
            reason=reasons[order].astype(np.int8),
            direction=np.full(count, self._sender, np.int8),
            time=None,
            clock=None,
            frame=[data[at] for at in order.tolist()],
        )
