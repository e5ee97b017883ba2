"""The bytes that a UART reads if they were sent at another rate than its own."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from random import Random

    from ..line.link import Link

# A UART looks at the line sixteen times a bit, so that it sees an edge by so much early or late.
JITTER = 1 / 32


def sampled(data: bytes, sent_at: float, read_at: float, link: Link, random: Random) -> bytes:
    """Sample `data`, sent in one go at `sent_at` baud, as a UART at `read_at` baud does.

    Both ends have the form of a byte that `link` has.

    Framing errors are passed on as they are read, as by a port in raw mode. A reader that is slower
    gets fewer bytes, or none at all; a faster one gets a byte for each stretch of low line; one
    that is off by a few percent reads what was sent.
    """
    # The line rests at 1, in front of the first byte, too.
    levels = b"\x01" + b"".join(_levels(byte, link) for byte in data)
    step = sent_at / read_at
    found = bytearray()
    at = 0
    while (edge := _falling_edge(levels, at)) >= 0:
        late = random.uniform(-JITTER, JITTER)
        if _level(levels, edge + step * (0.5 + late)):
            at = int(edge + step * 0.5)  # too short for a start bit
            continue
        moments = (edge + step * (1.5 + late + bit) for bit in range(link.data_bits))
        found.append(sum(_level(levels, moment) << bit for bit, moment in enumerate(moments)))
        # To the middle of the stop bit, behind which the next byte may begin.
        at = int(edge + step * (link.bits_per_byte - link.stop_bits + 0.5 + late))
    return bytes(found)


def _levels(byte: int, link: Link) -> bytes:
    """Return a start bit, those of the byte with the lowest first, parity, and stop bits."""
    bits = [byte >> bit & 1 for bit in range(link.data_bits)]
    odd = sum(bits) % 2
    parity = {"none": [], "even": [odd], "odd": [1 - odd], "mark": [1], "space": [0]}[link.parity]
    return bytes([0, *bits, *parity, *[1] * link.stop_bits])


def _level(levels: bytes, moment: float) -> int:
    at = int(moment)
    return levels[at] if at < len(levels) else 1


def _falling_edge(levels: bytes, at: int) -> int:
    """Return where the line falls next, once it is up; -1 if it does not."""
    up = levels.find(1, at)
    return -1 if up < 0 else levels.find(0, up)
