"""Explanation of bytes by the reference: `framewire.explain` with its verdicts."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from framewire.explain import explanation
from framewire.explain.explanation import Judgement, rows_of
from framewire.explain.slot_bytes import legal_length

from framegen.language.values import Direction
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framewire.explain.explanation import Explanation, Row

    from framegen.model.model import Model
    from framegen.model.verdict import Verdict


def explain(model: Model, data: bytes, directions: Sequence[Direction]) -> Explanation:
    """Explain `data` as one frame sent in any of `directions`."""
    judge = partial(_judge, model)
    return explanation.explain(model.protocol, judge, data, list(map(str, directions)))


def _judge(model: Model, direction: str, data: bytes) -> Judgement:
    verdict = weigh_whole(model, [Direction.parse(direction)], data)
    name = None if verdict.message is None else verdict.message.name
    return Judgement(name, verdict.reason, verdict.offset)


def seen_rows(model: Model, verdict: Verdict, data: bytes) -> tuple[Row, ...]:
    """Explain the slots that agreed with the beginning of a frame."""
    end = verdict.seen[-1].end if verdict.seen else 0
    likely = None if verdict.likely is None else model.protocol.messages[verdict.likely.name]
    slots = model.protocol.envelopes[verdict.frame].head if verdict.frame else ()
    if likely is not None and len(verdict.seen) > len(slots):
        length = legal_length(likely, data)
        slots = tuple(likely.lay_out(likely.lengths[0] if length is None else length))
    return rows_of(data, [placed for placed in slots if placed.end <= end], likely)
