"""The result of a check: its state, the observation, the bytes that show it, what to do next."""

from __future__ import annotations

from typing import NamedTuple

PASSED, FAILED, UNKNOWN = STATES = ("passed", "failed", "unknown")
# Of bytes that show the same, the first few are enough.
_MOST = 3


class Result(NamedTuple):
    """The result of a check. `advice` is empty if nothing is to be done."""

    state: str
    seen: str
    evidence: tuple[bytes, ...] = ()
    advice: str = ""


def passed(seen: str, *evidence: bytes) -> Result:
    """Return the result of a check that passed."""
    return Result(PASSED, seen, _first(evidence))


def failed(seen: str, advice: str, *evidence: bytes) -> Result:
    """Return the result of a check that failed; `advice` says what to do."""
    return Result(FAILED, seen, _first(evidence), advice)


def unknown(seen: str, advice: str = "", *evidence: bytes) -> Result:
    """Return the result of a check that is undecided, or differs from device to device."""
    return Result(UNKNOWN, seen, _first(evidence), advice)


def _first(evidence: tuple[bytes, ...]) -> tuple[bytes, ...]:
    return tuple(dict.fromkeys(filter(None, evidence)))[:_MOST]
