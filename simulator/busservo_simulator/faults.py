"""The faults to inject: how likely each is, and how long delays are."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields


def _chance(what_happens: str) -> float:
    return field(default=0.0, metadata={"chance": what_happens})


def _seconds(default: float, how_long: str) -> float:
    return field(default=default, metadata={"seconds": how_long})


@dataclass(frozen=True, slots=True)
class Faults:
    """Chances, 0 to 1, of faults on the way from the board to the host, and back.

    The same seed and the same traffic give the same faults. Those that end in `_to_board` happen to
    each piece that the host writes, all others to what the board sends. There is no checksum: a
    flipped bit in a value is a wrong value, and so may be the bytes that follow a lost one; on the
    way to the board, a flipped bit is another command.

    Raises ValueError for a chance outside 0 to 1, and for seconds that are no length of time.
    """

    seed: int = 0
    noise: float = _chance("bytes that hold no header come in front of a frame")
    bit_flips: float = _chance("a bit of a byte is turned over; the chance is that of each byte")
    lost_bytes: float = _chance("a byte of a frame is lost; the chance is that of each byte")
    splits: float = _chance("a frame comes in two pieces, with a pause between them")
    coalesced: float = _chance("a frame waits for the next one, and both come at once")
    delays: float = _chance("a frame comes later, by up to longest_delay, and so do all behind it")
    late: float = _chance("a reply comes later by late_by, and what is sent meanwhile passes it")
    duplicated: float = _chance("a reply is sent twice")
    dropped: float = _chance("a reply is never sent")
    fewer: float = _chance("a servo is left out of a reply; the chance is that of each servo")
    absent: float = _chance("a servo is reported off, by 65535; the chance is that of each servo")
    wrong_count: float = _chance("a reply counts one servo more, or fewer, than its length holds")
    unsolicited: float = _chance("an unsolicited report comes in front of a frame")
    hang_up: float = _chance("the line is cut in the middle of a frame")
    noise_to_board: float = _chance("bytes that hold no header come in front of what a host writes")
    bit_flips_to_board: float = _chance(
        "a bit of what a host writes is turned over; the chance is that of each byte"
    )
    splits_to_board: float = _chance(
        "what a host writes arrives in two pieces, with a pause between them"
    )
    longest_delay: float = _seconds(0.3, "how late a frame of the fault `delays` is at most")
    late_by: float = _seconds(1.0, "how late a reply of the fault `late` is")

    def __post_init__(self) -> None:
        for name in CHANCES:
            chance = getattr(self, name)
            if not 0 <= chance <= 1:
                raise ValueError(f"{name} is {chance}: a chance is from 0 to 1")
        for name in DURATIONS:
            seconds = getattr(self, name)
            if not 0 <= seconds < math.inf:
                raise ValueError(f"{name} is {seconds}: write seconds, 0 or more")


def _described(kind: str) -> dict[str, str]:
    return {each.name: each.metadata[kind] for each in fields(Faults) if kind in each.metadata}


CHANCES = _described("chance")
"""What happens, by the name of its chance."""

DURATIONS = _described("seconds")
"""What is so long, by the name of its seconds."""

TO_BOARD = tuple(name for name in CHANCES if name.endswith("_to_board"))
