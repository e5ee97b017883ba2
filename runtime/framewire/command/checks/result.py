"""The result of a check: its state, the observation, the bytes that show it, what to do next."""

from __future__ import annotations

from typing import NamedTuple

PASSED, FAILED, UNKNOWN = STATES = ("passed", "failed", "unknown")
# Of bytes that show the same, the first few are enough.
_MOST = 3


class Result(NamedTuple):
    """The result of a check.

    `advice` is empty if nothing is to be done, and `note` if nothing else is to be said.
    """

    state: str
    seen: str
    evidence: tuple[bytes, ...] = ()
    advice: str = ""
    note: str = ""


def passed(seen: str, *evidence: bytes, note: str = "") -> Result:
    """Return the result of a check that passed; `note` says what the check does not judge."""
    return Result(PASSED, seen, _first(evidence), note=note)


def failed(seen: str, advice: str, *evidence: bytes) -> Result:
    """Return the result of a check that failed; `advice` says what to do."""
    return Result(FAILED, seen, _first(evidence), advice)


def unknown(seen: str, advice: str = "", *evidence: bytes) -> Result:
    """Return the result of a check that is undecided, or differs from device to device."""
    return Result(UNKNOWN, seen, _first(evidence), advice)


def _first(evidence: tuple[bytes, ...]) -> tuple[bytes, ...]:
    return tuple(dict.fromkeys(filter(None, evidence)))[:_MOST]
