"""How much of a recording a spec explains, by the reference decoder."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.compile import compile_spec
from framegen.model.stream import ReferenceDecoder
from framegen.reading.source import Source

if TYPE_CHECKING:
    from framegen.guess.capture import Capture


def explained(spec: str, capture: Capture) -> str:
    """Return a sentence on the share of the bytes that are messages by a spec without findings."""
    model = compile_spec(Source("guess", spec)).model
    events = ReferenceDecoder(model, model.directions).decode(capture.data)
    frames = [event for event in events if event.kind == "message"]
    covered, size = sum(len(event.data) for event in frames), len(capture.data)
    share = f"{100 * covered / size:.1f} %" if covered < size else "all"
    first = f"the first {size}" if capture.is_cut else f"its {size}"
    return f"It explains {share} of {first} bytes, as {pluralize(len(frames), 'frame')}."
