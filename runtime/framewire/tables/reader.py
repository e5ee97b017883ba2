"""Read a capture as record batches: one for each table and stretch, whatever its size."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from ..recording.layout import NOISE
from ..recording.reader import read
from .by_entry import events_by_entry
from .columns import batch_of
from .noise_rows import NoiseRows
from .schema import schemas_of
from .search.searchable import frames_on
from .search.window import search
from .source import opened

if TYPE_CHECKING:
    from collections.abc import Iterator

    import pyarrow as pa

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from .events import Events, Frames
    from .schema import Schemas
    from .source import Capture, Source

BLOCK = 1 << 20
"""How many bytes of a capture are held at once, and the columns that are made of them."""

# How many entries of a recording.
_ENTRIES = 1 << 16

Batches: TypeAlias = "dict[str, pa.RecordBatch]"


def batches(
    codec: ProtocolCodec,
    source: Source,
    form: str,
    direction: Direction | None,
    block: int = BLOCK,
    start: int = 0,
) -> Iterator[Batches]:
    """Yield the tables of each stretch of a capture, by name, without those that are empty.

    `start` is the byte of a larger capture at which this one begins.
    """
    schemas = schemas_of(codec)
    rows = NoiseRows(schemas, codec.unknown_frame)
    with opened(source, form) as capture:
        for stretch in (each.moved(start) for each in events(codec, capture, direction, block)):
            made = _messages(schemas, stretch.frames)
            noise = rows.add(stretch.noise, stretch.end)
            if noise is not None:
                made[NOISE] = noise
            if made:
                yield made
    noise = rows.end()
    if noise is not None:
        yield {NOISE: noise}


def events(
    codec: ProtocolCodec, capture: Capture, direction: Direction | None, block: int
) -> Iterator[Events]:
    """Yield what an open capture holds, stretch by stretch."""
    legal = None if capture.is_text else frames_on(codec, direction)
    if legal is not None:
        return search(codec, capture.blocks(block), direction, legal)
    form = "hex" if capture.is_text else "raw"
    return events_by_entry(codec, read(codec, capture, form, direction), _ENTRIES)


def _messages(schemas: Schemas, frames: Frames) -> Batches:
    every = schemas.layouts.every
    return {
        every[kind].name: batch_of(schemas, every[kind], found) for kind, found in frames.by_kind()
    }
