"""The ways in which a frame is malformed on purpose, as a run of `framegen conform` names them."""

from __future__ import annotations

from framewire.explain.refusals import (
    BAD_CHECKSUM,
    BAD_TRAILER,
    COUNT_MISMATCH,
    LENGTH_MISMATCH,
    OUT_OF_RANGE,
    TOO_SHORT,
    UNKNOWN_COMMAND,
)

# Each with the reason for which it is no frame. The title of a step begins with one.
MALFORMED = {
    "a query cut short in its fields": TOO_SHORT,
    "a query cut short before its fields": TOO_SHORT,
    "a length that is one too many": LENGTH_MISMATCH,
    "a length that is one too few": LENGTH_MISMATCH,
    "a count that is one too many": COUNT_MISMATCH,
    "a count that is one too few": COUNT_MISMATCH,
    "a value out of its range": OUT_OF_RANGE,
    "an id that nobody has": UNKNOWN_COMMAND,
    "a checksum that is wrong": BAD_CHECKSUM,
    "an end that is another": BAD_TRAILER,
}


def malformed_in(title: str) -> frozenset[str]:
    """Return the reasons for which what a step with this title sends is no frame, if for any."""
    about = title.partition(",")[0]
    return frozenset({MALFORMED[about]} if about in MALFORMED else ())
