"""Frames of unknown command: without a checksum, claims that hold if no message begins in them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .chain import Chain, first_come
from .legal import UNKNOWN_COMMAND, UNKNOWN_KIND

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.direction import Direction
    from ..events import Bytes, Numbers
    from .legal import Judged


class Claims:
    """What judges claims on a line that carries one direction, or both for None."""

    def __init__(self, codec: ProtocolCodec, direction: Direction | None, header: bytes) -> None:
        self._table = codec.table_for(direction)
        self._lane = codec.noise_lane(self._table)
        self._header = header

    def put_between(self, chain: Chain, data: Bytes, places: Numbers, judged: Judged) -> Chain:
        """Return a chain with those claims between its frames that hold."""
        claims = np.flatnonzero((judged.reason == UNKNOWN_COMMAND) & (judged.size > 0))
        if not len(claims):
            return chain
        begins, ends = places[claims], places[claims] + judged.size[claims]
        behind = np.searchsorted(chain.start, begins, side="right")
        before = np.concatenate(([0], chain.end))[behind]
        after = np.concatenate((chain.start, [len(data)]))[behind]
        is_between = (before <= begins) & (ends <= after)
        begins, ends, behind = begins[is_between], ends[is_between], behind[is_between]
        alone = np.flatnonzero(self._stand_alone(data, places, begins, ends))
        held = alone[first_come(begins[alone], ends[alone])]
        at = behind[held]
        return Chain(
            np.insert(chain.start, at, begins[held]),
            np.insert(chain.end, at, ends[held]),
            np.insert(chain.kind, at, UNKNOWN_KIND),
            np.insert(chain.either, at, values=False),
        )

    def _stand_alone(
        self, data: Bytes, places: Numbers, begins: Numbers, ends: Numbers
    ) -> NDArray[np.bool_]:
        """Tell which claims prove by their own bytes that no message begins in them.

        That none does is known. A claim does not prove it if a header, whole or begun, stands so
        near its end that only later bytes refuse it.
        """
        last = np.searchsorted(places, ends) - 1
        header = places[last]
        is_sure = (header <= begins) | (header + self._table.reach <= ends)
        is_alone = np.ones(len(begins), np.bool_)
        for size in range(1, len(self._header)):
            is_begun = ends - size > begins
            for at, byte in enumerate(self._header[:size]):
                is_begun &= data.take(ends - size + at) == byte
            is_alone &= ~is_begun
        for number in np.flatnonzero(is_alone & ~is_sure).tolist():
            claim = data[begins[number] : ends[number]].tobytes()
            is_alone[number] = self._lane.stands_alone(claim, 0, len(claim))
        return is_alone
