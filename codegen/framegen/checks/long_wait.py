"""Remark: a false header can hold back what follows it for long."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.model import Model

# A client seldom waits that long for a reply.
_LONG = 1.0


def _look(model: Model) -> Iterator[Problem]:
    for way in model.directions:
        lists = [message for message in model.sent(way) if message.items is not None]
        longest = max(lists, key=lambda message: message.largest, default=None)
        if longest is None or longest.items is None:
            continue
        seconds = longest.wire_seconds(longest.largest)
        if seconds < _LONG:
            continue
        low = longest.items.low
        fits = int((_LONG / longest.wire_seconds(1) - longest.size_at(0)) / longest.items.size)
        yield Problem(
            ("messages", longest.name, "fields", longest.items.name),
            f"bytes that only look like the beginning of {longest.name} can hold back "
            f"{longest.largest} bytes behind them, {seconds:.1f} s at {model.spec.link.baud} baud",
            f"if there are never so many, bound them, such as by `count: {low}..{max(low, fits)}`",
            on_key=True,
        )


RULE = ModelRule(
    id="long-wait",
    title="A false header holds back little",
    why="Whoever decodes a line must wait for the frame that a header announces, as long as bytes "
    "arrive; where it is none, all that came meanwhile is decoded late. Frames that need to be "
    "long are, so this is a remark.",
    bad="data: {type: u8, sized_by: length}  # where the length is a u16",
    good="data: {type: u8, sized_by: length, count: 0..512}",
    look=_look,
)
