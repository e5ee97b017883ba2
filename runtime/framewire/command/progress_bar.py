"""How far a file has been read: a bar, the share, the rate, and the time that is left."""

from __future__ import annotations

_WIDTH = 20
# Before so many seconds, nobody knows how long it will take.
_SOON = 0.5


def progress_bar(done: int, size: int, seconds: float) -> str:
    """Return the bar for so many bytes of so many, after some seconds; `size` is 0 if unknown."""
    rate = done / seconds if seconds >= _SOON else 0.0
    speed = f", {rate / 1e6:.1f} MB/s" if rate else ""
    if not size:
        return f"{done / 1e6:.1f} MB read{speed}"
    share = min(done / size, 1.0)
    filled = int(share * _WIDTH)
    bar = "#" * filled + "." * (_WIDTH - filled)
    left = f", {_duration((size - done) / rate)} left" if rate and done < size else ""
    return f"[{bar}] {share:4.0%}  {done / 1e6:.1f} of {size / 1e6:.1f} MB read{speed}{left}"


def _duration(seconds: float) -> str:
    """Return a time as people say it: `7 s`, `2:05 min`, `1:10 h`."""
    whole = round(seconds)
    if whole < 60:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60}:{whole % 60:02} min"
    return f"{whole // 3600}:{whole % 3600 // 60:02} h"
