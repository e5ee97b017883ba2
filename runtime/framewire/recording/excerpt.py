"""A part of a recording, from one time to another: what is asked for, and how it is written."""

from __future__ import annotations

import re
from datetime import datetime, timezone

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

_SECONDS = r"(?:(\d{1,9}(?:\.\d{1,9})?|\.\d{1,9})s?)?"
_SINCE = re.compile(rf"(?:(\d{{1,6}})h)?(?:(\d{{1,8}})m)?{_SECONDS}", re.ASCII)
_DAY = re.compile(
    r"(\d{4}-\d\d-\d\d)[ T](\d\d:\d\d)(:\d\d)?(\.\d{1,6})?(?: ?(Z|UTC|[+-]\d\d:?\d\d))?", re.ASCII
)
# Recordings hold microseconds; what differs by less is the same moment.
_NEAR = 5e-7


class ExcerptError(ValueError):
    """A part that a recording does not have; the text says what it has."""


class Moment:
    """A time in a recording: seconds since it began or, if `is_clock`, since 1970; and its word."""

    __slots__ = ("is_clock", "seconds", "word")

    def __init__(self, word: str) -> None:
        """Read `90`, `1m30s`, `1h`, or a date with a time. Raises ValueError."""
        self.word = word
        since = _SINCE.fullmatch(word) if word else None
        self.is_clock = since is None
        if since is None:
            self.seconds = _clock(word)
        else:
            hours, minutes, seconds = (float(each or 0) for each in since.groups())
            self.seconds = 3600 * hours + 60 * minutes + seconds


class Excerpt:
    """What lies between two moments, both included; None for the beginning or the end.

    Raises ExcerptError if the first is behind the last.
    """

    __slots__ = ("begin", "end")

    def __init__(self, begin: Moment | None, end: Moment | None) -> None:
        self.begin = begin
        self.end = end
        if begin is None or end is None or begin.is_clock != end.is_clock:
            return
        if begin.seconds > end.seconds:
            raise ExcerptError(f"--from {begin.word} is behind --to {end.word}")

    @property
    def words(self) -> str:
        """What it is, as in `from 1m to 90s`."""
        pairs = (("from", self.begin), ("to", self.end))
        return " ".join(f"{name} {each.word}" for name, each in pairs if each is not None)

    @property
    def needs_clock(self) -> bool:
        """Whether a time of day is asked for."""
        return any(each is not None and each.is_clock for each in (self.begin, self.end))

    def bounds(self, *, clock: bool) -> tuple[float, float]:
        """Return the first and the last second of it, of the recording or of the `clock`."""
        begin, end = (
            each.seconds if each is not None and each.is_clock == clock else other
            for each, other in ((self.begin, float("-inf")), (self.end, float("inf")))
        )
        return begin - _NEAR, end + _NEAR

    def refuse(self, span: tuple[float, float], clock: tuple[float, float] | None) -> NoReturn:
        """Raise ExcerptError: nothing lies in it of a recording that has this span."""
        has = f"it goes from {span[0]:.3f} s to {span[1]:.3f} s"
        if clock is not None:
            has += f", {_said(clock[0])} to {_said(clock[1])} UTC"
        for at in (self.begin, self.end):
            if at is not None:
                low, high = (clock or span) if at.is_clock else span
                if at is self.begin and at.seconds > high:
                    raise ExcerptError(f"--from {at.word} is behind its end: {has}")
                if at is self.end and at.seconds < low:
                    raise ExcerptError(f"--to {at.word} is before its first event: {has}")
        raise ExcerptError(f"nothing came {self.words}: {has}")


def _clock(word: str) -> float:
    """Return seconds since 1970; a time without a zone is in UTC. Raises ValueError."""
    problem = ValueError(
        f"{word[:40]!r} is no time: write it like 90, 1m30s or 1h, or like 2026-01-31T09:05:00Z"
    )
    found = _DAY.fullmatch(word)
    if found is None:
        raise problem
    day, minute, second, part, zone = found.groups()
    offset = "+0000" if zone in (None, "Z", "UTC") else zone.replace(":", "")
    try:
        at = datetime.strptime(f"{day} {minute}{second or ':00'} {offset}", "%Y-%m-%d %H:%M:%S %z")
        return at.timestamp() + float(part or 0)
    except (ValueError, OverflowError):  # the 31st of February, or 25 o'clock
        raise problem from None


def _said(clock: float) -> str:
    return f"{datetime.fromtimestamp(clock, timezone.utc):%Y-%m-%d %H:%M:%S}"
