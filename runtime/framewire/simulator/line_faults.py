"""The faults that can happen on any line: how likely each is, and how long delays are."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields


def chance(what_happens: str) -> float:
    """Declare the chance of a fault, with what happens."""
    return field(default=0.0, metadata={"chance": what_happens})


def seconds(default: float, how_long: str) -> float:
    """Declare a length of time, with what takes so long."""
    return field(default=default, metadata={"seconds": how_long})


@dataclass(frozen=True, slots=True)
class LineFaults:
    """Chances, 0 to 1, of faults on the way from a device to the host, and back.

    The same seed and the same traffic give the same faults. Those that end in `_to_board` happen to
    each piece that the host writes, all others to what the device sends.

    Raises ValueError for a chance outside 0 to 1, and for seconds that are no length of time.
    """

    seed: int = 0
    noise: float = chance("bytes that hold no header come in front of a frame")
    bit_flips: float = chance("a bit of a byte is turned over; the chance is that of each byte")
    lost_bytes: float = chance("a byte of a frame is lost; the chance is that of each byte")
    splits: float = chance("a frame comes in two pieces, with a pause between them")
    coalesced: float = chance("a frame waits for the next one, and both come at once")
    delays: float = chance("a frame comes later, by up to longest_delay, and so do all behind it")
    late: float = chance("a reply comes later by late_by, and what is sent meanwhile passes it")
    duplicated: float = chance("a reply is sent twice")
    dropped: float = chance("a reply is never sent")
    hang_up: float = chance("the line is cut in the middle of a frame")
    noise_to_board: float = chance("bytes that hold no header come in front of what a host writes")
    bit_flips_to_board: float = chance(
        "a bit of what a host writes is turned over; the chance is that of each byte"
    )
    splits_to_board: float = chance(
        "what a host writes arrives in two pieces, with a pause between them"
    )
    longest_delay: float = seconds(0.3, "how late a frame of the fault `delays` is at most")
    late_by: float = seconds(1.0, "how late a reply of the fault `late` is")

    def __post_init__(self) -> None:
        for name in described(type(self), "chance"):
            value = getattr(self, name)
            if not 0 <= value <= 1:
                raise ValueError(f"{name} is {value}: a chance is from 0 to 1")
        for name in described(type(self), "seconds"):
            value = getattr(self, name)
            if not 0 <= value < math.inf:
                raise ValueError(f"{name} is {value}: write seconds, 0 or more")


def described(kind: type[LineFaults], what: str) -> dict[str, str]:
    """Describe the chances (`chance`) or the lengths of time (`seconds`) of faults, by name."""
    return {each.name: each.metadata[what] for each in fields(kind) if what in each.metadata}
