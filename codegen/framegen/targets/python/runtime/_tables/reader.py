"""Read a capture as record batches: one for each table and stretch, whatever its size."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from ..recordings import read
from .by_entry import found_by_entry
from .columns import batch_of
from .layout import layouts
from .schema import NOISE
from .search import search, sent
from .searchable import is_searchable
from .source import opened
from .stray_rows import StrayRows

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pyarrow as pa

    from .._frame.direction import Direction
    from .found import Found, Frames
    from .source import Capture, Source

BLOCK = 1 << 20
"""How many bytes of a capture are held at once, and the columns that are made of them."""

# How many entries of a recording.
_ENTRIES = 1 << 16

Batches: TypeAlias = "dict[str, pa.RecordBatch]"


def batches(
    source: Source, form: str, direction: Direction | None, block: int = BLOCK, start: int = 0
) -> Iterator[Batches]:
    """Yield the tables of each stretch of a capture, by name, without those that are empty.

    `start` is the byte of a larger capture at which this one begins.
    """
    rows = StrayRows()
    with opened(source, form) as capture:
        for stretch in (each.moved(start) for each in found(capture, direction, block)):
            made = _messages(stretch.frames)
            noise = rows.add(stretch.stray, stretch.end)
            if noise is not None:
                made[NOISE] = noise
            if made:
                yield made
    noise = rows.end()
    if noise is not None:
        yield {NOISE: noise}


def found(capture: Capture, direction: Direction | None, block: int) -> Iterator[Found]:
    """Yield what an open capture holds, stretch by stretch."""
    if not capture.is_text and is_searchable(sent(direction)):
        return search(capture.blocks(block), direction)
    form = "hex" if capture.is_text else "raw"
    return found_by_entry(read(capture, form=form, direction=direction), _ENTRIES)


def _messages(frames: Frames) -> Batches:
    every = layouts()
    return {every[kind].name: batch_of(every[kind], found) for kind, found in frames.by_kind()}
