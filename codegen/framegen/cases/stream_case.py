"""What a line brings: its title, the pieces in which it arrives, and where it goes quiet."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from framegen.language.values import Direction

# Where the line goes quiet.
QUIET = None

# Pieces of bytes, and QUIET.
Parts: TypeAlias = "tuple[bytes | None, ...]"


@dataclass(frozen=True, slots=True)
class StreamCase:
    """What arrives, and how large a frame may be there; None is the largest of the direction."""

    title: str
    direction: Direction
    parts: Parts
    max_frame: int | None = None


def single_bytes(data: bytes) -> Parts:
    """A piece for each byte."""
    return chunks(data, 1)


def chunks(data: bytes, size: int) -> Parts:
    """Pieces of `size` bytes, and what is left."""
    return tuple(data[at : at + size] for at in range(0, len(data), size))
