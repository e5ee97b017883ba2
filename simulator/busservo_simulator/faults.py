"""The faults to inject into a board's line: how likely each is, and how long delays are."""

from __future__ import annotations

from dataclasses import dataclass

from framewire.simulator.line_faults import LineFaults, chance, described


@dataclass(frozen=True, slots=True)
class Faults(LineFaults):
    """Chances, 0 to 1, of faults on the way from the board to the host, and back.

    The same seed and the same traffic give the same faults. Those that end in `_to_board` happen to
    each piece that the host writes, all others to what the board sends. There is no checksum: a
    flipped bit in a value is a wrong value, and so may be the bytes that follow a lost one; on the
    way to the board, a flipped bit is another command.

    Raises ValueError for a chance outside 0 to 1, and for seconds that are no length of time.
    """

    fewer: float = chance("a servo is left out of a reply; the chance is that of each servo")
    absent: float = chance("a servo is reported off, by 65535; the chance is that of each servo")
    wrong_count: float = chance("a reply counts one servo more, or fewer, than its length holds")
    unsolicited: float = chance("an unsolicited report comes in front of a frame")


CHANCES = described(Faults, "chance")
"""What happens, by the name of its chance."""

DURATIONS = described(Faults, "seconds")
"""What is so long, by the name of its seconds."""

TO_BOARD = tuple(name for name in CHANCES if name.endswith("_to_board"))
