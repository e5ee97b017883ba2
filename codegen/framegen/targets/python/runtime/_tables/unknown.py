"""Frames of unknown command: without a checksum, claims that hold if no message begins in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._codec.decoder import StreamDecoder
from .._codec.noise import UnknownFrame
from .chain import Chain, first_come
from .doubt import decided
from .legal import UNKNOWN_COMMAND, UNKNOWN_KIND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .._explanation.protocol import Envelope
    from .._frame.direction import Direction
    from .found import Bytes, Numbers
    from .legal import Judged


def with_unknown(
    chain: Chain,
    data: Bytes,
    places: Numbers,
    judged: Judged,
    envelope: Envelope,
    direction: Direction | None,
) -> Chain:
    """Return a chain with those claims between its frames that hold."""
    claims = np.flatnonzero((judged.reason == UNKNOWN_COMMAND) & (judged.size > 0))
    if not len(claims):
        return chain
    begins, ends = places[claims], places[claims] + judged.size[claims]
    behind = np.searchsorted(chain.start, begins, side="right")
    before = np.concatenate(([0], chain.end))[behind]
    after = np.concatenate((chain.start, [len(data)]))[behind]
    free = np.flatnonzero((before <= begins) & (ends <= after))
    free = free[~_cut_header(data, ends[free], envelope.header)]
    if not len(free):
        return chain
    # Alive is what may become a message behind the claim; dead is what cannot, whatever comes.
    least, most = decided(judged, envelope)
    first, last = claims[free] + 1, np.searchsorted(places, ends[free])
    # Mostly it is the last header that does.
    is_alive = (first < last) & ((places + least).take(last - 1) > ends[free])
    free, first, last = free[~is_alive], first[~is_alive], last[~is_alive]
    is_alive = most_of(places + least, first, last) > ends[free]
    is_dead = most_of(places + most, first, last) <= ends[free]
    for number in np.flatnonzero(~is_alive & ~is_dead).tolist():
        begin, end = int(begins[free[number]]), int(ends[free[number]])
        is_dead[number] = _stands_alone(data[begin:end].tobytes(), direction)
    held = free[is_dead]
    held = held[first_come(begins[held], ends[held])]
    at = behind[held]
    return Chain(
        np.insert(chain.start, at, begins[held]),
        np.insert(chain.end, at, ends[held]),
        np.insert(chain.kind, at, UNKNOWN_KIND),
        np.insert(chain.either, at, values=False),
    )


def _cut_header(data: Bytes, ends: Numbers, header: bytes) -> NDArray[np.bool_]:
    """Tell in front of which places a header begins that is not all there."""
    found = np.zeros(len(ends), np.bool_)
    for size in range(1, len(header)):
        is_cut = np.ones(len(ends), np.bool_)
        for at, byte in enumerate(header[:size]):
            is_cut &= data.take(ends - size + at) == byte
        found |= is_cut
    return found


def most_of(numbers: Numbers, first: Numbers, last: Numbers) -> Numbers:
    """Return the largest of `numbers[first:last]`, for many such stretches; 0 for an empty one."""
    most: Numbers = np.zeros(len(first), np.int64)
    left = last - first
    width = 1
    while len(numbers) and (left >= width).any():
        # Two windows of one width, which may overlap, hold all of a stretch.
        which = np.flatnonzero((left >= width) & (left < 2 * width))
        windows = numbers.take(first[which]), numbers.take(last[which] - width)
        most[which] = np.maximum(*windows)
        numbers = np.maximum(numbers[:-width], numbers[width:])
        width *= 2
    return most


def _stands_alone(claimed: bytes, direction: Direction | None) -> bool:
    """Tell whether bytes prove by themselves that no message begins in them."""
    events = StreamDecoder(direction).feed(claimed)
    return len(events) == 1 and isinstance(events[0], UnknownFrame) and events[0].data == claimed
