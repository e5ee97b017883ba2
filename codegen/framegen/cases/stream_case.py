"""One stream as a test case: its title, its chunks, and where the line goes quiet."""

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
    """The chunks of a stream; `max_frame` bounds a frame, None for no bound."""

    title: str
    direction: Direction
    parts: Parts
    max_frame: int | None = None


def single_bytes(data: bytes) -> Parts:
    """Cut data into single bytes."""
    return chunks(data, 1)


def chunks(data: bytes, size: int) -> Parts:
    """Cut data into pieces of `size` bytes; the last may be shorter."""
    return tuple(data[at : at + size] for at in range(0, len(data), size))
