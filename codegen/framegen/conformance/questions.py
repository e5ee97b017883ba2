"""Every test case of a protocol, as questions to a codec."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.invalid import invalid_frames
from framegen.cases.streams import streams
from framegen.cases.unencodable import unencodable
from framegen.cases.valid import valid_frames
from framegen.conformance.language import Decode, Encode, Stream
from framegen.conformance.round_trips import round_trips

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.conformance.language import Question
    from framegen.model.model import Model


def questions(model: Model) -> Iterator[tuple[str, Question]]:
    """Yield questions on each frame both ways, on invalid frames and on streams, with titles.

    Then on frames of random values, which are the same in every run.
    """
    for frame in valid_frames(model):
        title = f"{frame.message.name}: {frame.title}"
        yield title, Decode(frame.message.direction, frame.data)
        yield title, Encode(frame.message, frame.values)
    for unfit in unencodable(model):
        yield unfit.title, Encode(unfit.message, unfit.values)
    for wrong in invalid_frames(model):
        yield wrong.title, Decode(wrong.direction, wrong.data)
    for case in streams(model):
        largest = model.largest([case.direction])
        yield case.title, Stream(case.direction, case.max_frame or largest, case.parts)
    yield from round_trips(model)
