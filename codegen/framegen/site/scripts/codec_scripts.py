"""The files of the codec for pages, in the order in which they are joined."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.model.model import Model

_DECODE = ("hex", "numbers", "layout", "line", "verdict", "stream", "words", "values", "rows")
_ENCODE = ("events", "encode", "codec")
_EXPLAIN = ("closest", "refusals", "lookalikes", "hints", "explain")


def codec_scripts(model: Model) -> tuple[str, ...]:
    """Return the files of a codec for one protocol, without those that it does not need."""
    frames = [*model.envelopes.values(), *model.lookalikes.values()]
    proven = any(frame.checksums for frame in frames)
    return (*(("checksums",) if proven else ()), *_DECODE, *_ENCODE, *_EXPLAIN)
