"""How much of what begins as a frame must be there, to tell that it is none."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._frame.errors import Reason
from .fields import NO_KIND
from .legal import UNKNOWN_COMMAND

if TYPE_CHECKING:
    from .._explanation.protocol import Envelope
    from .found import Numbers
    from .legal import Judged

_LENGTH_MISMATCH = [*Reason].index(Reason.LENGTH_MISMATCH)
# More than any frame has.
_NEVER = 1 << 40


def decided(judged: Judged, envelope: Envelope) -> tuple[Numbers, Numbers]:
    """Return how many bytes of each are needed, at the least, to refuse it; and how many surely do.

    In between, its fields decide. A part of a head tells nothing before it is there as a whole.
    """
    ends = {
        role: [placed.end for placed in envelope.head if placed.slot.role == role]
        for role in ("length", "id", "address")
    }
    length, ids = ends["length"][0], ends["id"]
    fields = envelope.body_at + 1
    until = np.full(len(judged.kind), min([fields, *ends["address"]]), np.int64)
    since = np.maximum(judged.size, envelope.body_at).astype(np.int64)
    is_unknown = judged.reason == UNKNOWN_COMMAND
    until[is_unknown], since[is_unknown] = ids[0], ids[-1]
    is_length = judged.reason == _LENGTH_MISMATCH
    need = np.where(judged.size > 0, max(length, ids[-1]), length)[is_length]
    until[is_length] = since[is_length] = need
    is_message = judged.kind != NO_KIND
    until[is_message] = since[is_message] = _NEVER
    return until, since
