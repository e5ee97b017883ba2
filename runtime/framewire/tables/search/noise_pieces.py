"""The noise between frames, in pieces: each refused header begins one, with a reason of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..events import Numbers
    from .chain import Chain


def noise_pieces(
    chain: Chain, until: int, refused: Numbers, reasons: NDArray[Any], first: int, usual: int
) -> tuple[Numbers, Numbers, Numbers]:
    """Return where each piece of noise begins and ends in front of `until`, and its reason.

    `refused` are the headers that begin no frame, and `reasons` says why. Noise without a header is
    noise for the reason `usual`; at the very beginning, for the reason `first`.
    """
    begins = np.concatenate(([0], chain.end))
    ends = np.concatenate((chain.start, [until]))
    is_gap = begins < ends
    if not is_gap.any():
        nothing = np.empty(0, np.int64)
        return nothing, nothing, nothing
    why: Numbers = np.full(len(begins), usual)
    why[0] = first
    begins, ends, why = begins[is_gap], ends[is_gap], why[is_gap]
    gap = np.searchsorted(begins, refused, side="right") - 1
    inside = (gap >= 0) & (refused < ends[gap])
    refused, reasons, gap = refused[inside], reasons[inside], gap[inside]
    # A header at the beginning of a gap takes the place of the gap's own piece, which comes first.
    at = np.concatenate((begins, refused))
    order = np.argsort(at, kind="stable")
    at = at[order]
    reason = np.concatenate((why, reasons))[order]
    of_gap = np.concatenate((np.arange(len(begins)), gap))[order]
    is_last = np.concatenate((at[1:] != at[:-1], [True]))
    at, reason, of_gap = at[is_last], reason[is_last], of_gap[is_last]
    begins_anew = (of_gap[1:] != of_gap[:-1]) | (reason[1:] != reason[:-1])
    is_piece = np.concatenate(([True], begins_anew))
    at, reason, of_gap = at[is_piece], reason[is_piece], of_gap[is_piece]
    same_gap = np.concatenate((of_gap[1:] == of_gap[:-1], [False]))
    end = np.where(same_gap, np.concatenate((at[1:], [until])), ends[of_gap])
    return at, end, reason
