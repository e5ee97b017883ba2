"""The faults that can be asked for, each as the chance that it happens."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(frozen=True, slots=True)
class Faults:
    """Chances, 0 to 1, of what can go wrong on the way from the board to the host, and back.

    The same seed and the same traffic give the same faults. There is no checksum: a flipped bit in
    a value is a wrong value, and no host can tell; on the way to the board, it is another command.
    Every other fault can be told or outlived. Those that end in `_to_board` happen to each piece
    that the host writes, all others to what the board sends.
    """

    seed: int = 0
    noise: float = 0.0
    """Bytes that hold no header come in front of a frame."""
    bit_flips: float = 0.0
    """A bit of a byte is turned over; the chance is that of each byte."""
    splits: float = 0.0
    """A frame comes in two pieces, with a pause between them."""
    coalesced: float = 0.0
    """A frame waits for the next one, and both come at once."""
    delays: float = 0.0
    """A frame comes late, by up to `longest_delay` seconds."""
    dropped: float = 0.0
    """A reply is never sent."""
    fewer: float = 0.0
    """A servo is left out of a reply; the chance is that of each servo."""
    absent: float = 0.0
    """A servo is told to be off, by 65535; the chance is that of each servo."""
    unasked: float = 0.0
    """A report about an action group that nobody asked for comes in front of a frame."""
    hang_up: float = 0.0
    """The line is cut in the middle of a frame."""
    noise_to_board: float = 0.0
    """Bytes that hold no header arrive in front of what the host writes."""
    bit_flips_to_board: float = 0.0
    """A bit of a byte that the host writes is turned over; the chance is that of each byte."""
    splits_to_board: float = 0.0
    """What the host writes arrives in two pieces, with a pause between them."""
    longest_delay: float = 0.3
    """In seconds."""

    def __post_init__(self) -> None:
        for name in CHANCES:
            chance = getattr(self, name)
            if not 0 <= chance <= 1:
                raise ValueError(f"{name} is {chance}: a chance is from 0 to 1")


CHANCES = tuple(
    field.name for field in fields(Faults) if field.name not in {"seed", "longest_delay"}
)

TO_BOARD = tuple(name for name in CHANCES if name.endswith("_to_board"))
