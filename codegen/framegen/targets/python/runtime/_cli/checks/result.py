"""What a check has found: its state, what was seen, the bytes that show it, and what to do next."""

from __future__ import annotations

from typing import NamedTuple

PASSED, FAILED, UNKNOWN = STATES = ("passed", "failed", "unknown")
# Of bytes that show the same, the first few are enough.
_MOST = 3


class Result(NamedTuple):
    """What a check has found. `advice` is empty where nothing is to be done."""

    state: str
    seen: str
    evidence: tuple[bytes, ...] = ()
    advice: str = ""


def passed(seen: str, *evidence: bytes) -> Result:
    """All is as it should be."""
    return Result(PASSED, seen, _first(evidence))


def failed(seen: str, advice: str, *evidence: bytes) -> Result:
    """Something is not as it should be; `advice` says what to do."""
    return Result(FAILED, seen, _first(evidence), advice)


def unknown(seen: str, advice: str = "", *evidence: bytes) -> Result:
    """It could not be told, or it is as it should be for some devices only."""
    return Result(UNKNOWN, seen, _first(evidence), advice)


def _first(evidence: tuple[bytes, ...]) -> tuple[bytes, ...]:
    return tuple(dict.fromkeys(filter(None, evidence)))[:_MOST]
