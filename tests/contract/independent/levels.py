"""A second opinion, written apart: what a port receives, bit by bit, at another rate or inverted.

Ten bits a byte: a start bit, eight of data with the lowest first, a stop bit. A receiver waits for
the line to fall, and looks at the middle of each bit, by its own rate.
"""

from collections.abc import Iterator

BITS = 10


def received(data: bytes, *, sent_at: float, read_at: float, inverted: bool = False) -> bytes:
    """Return what is received of bytes that were sent without a pause, and a byte's quiet after."""
    levels = [*_levels(data), *[True] * BITS]
    if inverted:
        levels = [not level for level in levels]
    return bytes(_read(levels, read_at / sent_at, idle=not inverted))


def _levels(data: bytes) -> Iterator[bool]:
    for byte in data:
        yield False
        yield from (bool(byte >> bit & 1) for bit in range(8))
        yield True


def _read(levels: list[bool], rate: float, *, idle: bool) -> Iterator[int]:
    def at(moment: float) -> bool:
        place = int(moment)
        return levels[place] if place < len(levels) else idle

    fine = 1 / (16 * max(rate, 1))
    moment, before = 0.0, idle
    while moment < len(levels):
        now = at(moment)
        if before and not now and not at(moment + 0.5 / rate):
            yield sum(at(moment + (bit + 1.5) / rate) << bit for bit in range(8))
            # The middle of the stop bit; where it is low, the line has to rise first.
            moment += (BITS - 0.5) / rate
            now = at(moment)
        before = now
        moment += fine
