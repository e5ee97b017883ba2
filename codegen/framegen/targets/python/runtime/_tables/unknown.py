"""Frames of unknown command: without a checksum, claims that hold if no message begins in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._codec.decoder import StreamDecoder
from .._codec.noise import UnknownFrame
from .chain import Chain
from .legal import UNKNOWN_COMMAND, UNKNOWN_KIND

if TYPE_CHECKING:
    from .._frame.direction import Direction
    from .found import Bytes, Numbers
    from .legal import Judged


def with_unknown(
    chain: Chain, data: Bytes, places: Numbers, judged: Judged, direction: Direction | None
) -> Chain:
    """Return a chain with those claims between its frames that hold."""
    claims = np.flatnonzero((judged.reason == UNKNOWN_COMMAND) & (judged.size > 0))
    if not len(claims):
        return chain
    begins, ends = places[claims], places[claims] + judged.size[claims]
    behind = np.searchsorted(chain.start, begins, side="right")
    before = np.concatenate(([0], chain.end))[behind]
    after = np.concatenate((chain.start, [len(data)]))[behind]
    held: list[int] = []
    free_from = 0
    for number in np.flatnonzero((before <= begins) & (ends <= after)).tolist():
        begin, end = int(begins[number]), int(ends[number])
        if begin >= free_from and _stands_alone(data[begin:end].tobytes(), direction):
            held.append(number)
            free_from = end
    if not held:
        return chain
    at = behind[held]
    return Chain(
        np.insert(chain.start, at, begins[held]),
        np.insert(chain.end, at, ends[held]),
        np.insert(chain.kind, at, UNKNOWN_KIND),
        np.insert(chain.either, at, values=False),
    )


def _stands_alone(claimed: bytes, direction: Direction | None) -> bool:
    """Tell whether bytes prove by themselves that no message begins in them."""
    events = StreamDecoder(direction).feed(claimed)
    return len(events) == 1 and isinstance(events[0], UnknownFrame) and events[0].data == claimed
