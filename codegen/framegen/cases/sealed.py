"""Frames that were changed, with the checksums that they should then have."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.model.envelope import Envelope


def sealed(frame: Envelope, ids: dict[str, int], data: bytes) -> bytes:
    """Return the bytes of a whole frame with other ids, say, but the right checksums."""
    for checksum in frame.checksums:
        at = checksum.at if checksum.at >= 0 else len(data) + checksum.at
        right = frame.covered(checksum, ids).checksum(checksum, data)
        data = data[:at] + right + data[at + checksum.size :]
    return data
