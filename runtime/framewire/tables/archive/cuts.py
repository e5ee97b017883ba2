"""Places where a capture can be cut, so that its pieces hold the events of the whole.

A place c is safe if a legal frame [h, c) ends there, and no header in front of h claims a byte of
it. A decoder that began at h or before never skips h: what it reads in front of h ends there at the
latest, since no frame that begins there reaches further. So it reads the frame, and has it read at
c, since no header in front of h waits for a byte behind h. Nothing is held at c, all in front of c
is emitted, and noise begins anew, as for a decoder that begins at c.

A header further in front than the largest frame claims no byte behind h: so the place is proven by
the bytes around it, wherever the decoder began.
"""

from __future__ import annotations

import os
from itertools import accumulate
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...codec.event_bytes import bytes_of
from ...codec.noise import Noise
from ..places import find_all
from ..search.searchable import frames_on

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ...frame.message import Message
    from ..events import Bytes
    from ..search.legal import LegalFrames

    Read = Callable[[int, int], bytes]

# How far a safe place is looked for, in largest frames: at first, and how much further each time.
_FRAMES = 4
# Frames of protocols that are not searched at once are tried one by one: that takes the square.
_TRIED = 1 << 10


def safe_cuts(
    codec: ProtocolCodec,
    file: str | os.PathLike[str] | bytes | bytearray | memoryview,
    size: int,
    direction: Direction | None,
) -> list[int]:
    """Return places of a raw capture, about `size` bytes apart, where any decoder holds nothing.

    Raises OSError for a file that cannot be read, and ValueError for a size below 1.
    """
    if size < 1:
        raise ValueError(f"size is {size}, and a piece has at least 1 byte")
    if not isinstance(file, (str, os.PathLike)):
        held = memoryview(file).cast("B")
        return [
            *_cuts(codec, lambda start, end: bytes(held[start:end]), len(held), size, direction)
        ]
    with Path(file).open("rb", buffering=0) as stream:

        def read(start: int, end: int) -> bytes:
            stream.seek(start)
            return stream.read(end - start)

        return [*_cuts(codec, read, stream.seek(0, os.SEEK_END), size, direction)]


def _cuts(
    codec: ProtocolCodec, read: Read, length: int, size: int, direction: Direction | None
) -> Iterator[int]:
    largest, proven = _prover(codec, direction) if size < length else (0, None)
    if proven is None:
        return
    about = size
    while about < length:
        place, searched = _place_near(read, about, length, largest, proven)
        if place is not None:
            yield place
        about = max(about + size, searched + 1) if place is None else place + size


def _prover(
    codec: ProtocolCodec, direction: Direction | None
) -> tuple[int, _Proven | _Tried | None]:
    """Return the size of the largest frame on a line, and what proves its places, if anything."""
    largest, legal = codec.table_for(direction).largest, frames_on(codec, direction)
    if legal is not None:
        return largest, _Proven(legal)
    # There is no frame at all where nothing is sent.
    return largest, _Tried(codec, direction, largest) if 0 < largest <= _TRIED else None


def _place_near(
    read: Read, about: int, length: int, largest: int, proven: _Proven | _Tried
) -> tuple[int | None, int]:
    """Return the first safe place from `about` on, and up to where there is no other."""
    # A frame that ends at the place, begins so far behind the window's first byte that all headers
    # are seen which may claim bytes of it.
    start = max(0, about - 2 * largest)
    reach = _FRAMES * largest
    while True:
        data = read(start, start + reach)
        searched = start + len(data)
        # The end of the capture is no place to cut it.
        ends = (start + end for end in proven.ends(data, about - start))
        place = next((end for end in ends if end < length), None)
        if place is not None or reach >= proven.furthest or searched >= length:
            return place, searched
        reach *= _FRAMES


class _Proven:
    """Frames judged at many places at once."""

    def __init__(self, legal: LegalFrames) -> None:
        self._legal = legal
        self.furthest = 1 << 20

    def ends(self, data: bytes, about: int) -> Iterator[int]:
        """Yield safe places from `about` on."""
        window: Bytes = np.frombuffer(data + bytes(self._legal.largest), np.uint8)
        places = find_all(window[: len(data)], self._legal.envelope.header)
        judged = self._legal.judge(window, places)
        ends = places + judged.size
        # How far the headers in front of each claim bytes.
        claimed = np.concatenate(([0], np.maximum.accumulate(ends)[:-1]))[: len(ends)]
        safe = (judged.kind >= 0) & (claimed <= places)
        safe &= (ends <= len(data)) & (ends >= about)
        yield from ends[safe].tolist()


class _Tried:
    """Frames of other protocols: a decoder tries each place from which one may come to a frame."""

    def __init__(self, codec: ProtocolCodec, direction: Direction | None, largest: int) -> None:
        self._codec = codec
        self._direction = direction
        self._largest = largest
        # To try a frame takes time.
        self.furthest = 16 * largest

    def ends(self, data: bytes, about: int) -> Iterator[int]:
        """Yield safe places from `about` on."""
        events: Sequence[Message | Noise] = self._codec.decoder(self._direction).feed(data)
        sizes = [len(bytes_of(each)) for each in events]
        for event, size, end in zip(events, sizes, accumulate(sizes), strict=True):
            is_message = not isinstance(event, Noise)
            if is_message and end >= about:
                begin = end - size
                if all(map(self._is_read, self._lines(data, begin, end))):
                    yield end

    def _lines(self, data: bytes, begin: int, end: int) -> Iterator[tuple[bytes, int]]:
        for start in range(max(0, begin - self._largest + 1), begin + 1):
            yield data[start:end], end - begin

    def _is_read(self, line: tuple[bytes, int]) -> bool:
        """Tell whether a decoder reads a frame of some size last, and holds nothing."""
        data, size = line
        decoder = self._codec.decoder(self._direction)
        events: Sequence[Message | Noise] = decoder.feed(data)
        last = events[-1] if events else None
        return not (decoder.pending or last is None or isinstance(last, Noise)) and (
            len(last.encode()) == size
        )
