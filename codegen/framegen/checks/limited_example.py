"""Rule: an example stays within the limits of at least one device."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.model.codec import NotAFrame, decode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Limits
    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.messages.items():
        for number, example in enumerate(message.message.examples if message.limited else ()):
            try:
                values = decode(model, message.direction, example.hex).values
            except NotAFrame:
                # The rule `example` speaks of it.
                continue
            for path, limits in message.limited.items():
                outer, _, inner = path.partition(".")
                given = values[outer]
                # A field that is absent has no value.
                for item in given if isinstance(given, list) else [given]:
                    value = item[inner] if inner else item
                    if value is not None and not _inside(limits, value):
                        here = ("messages", name, "examples", number, "values", outer)
                        what = f"`{inner or outer}` is {value}, outside all limits"
                        yield Problem(here, what, "correct the example, or widen the limits")


def _inside(limits: Limits, value: int) -> bool:
    ranges = [limits.usual, *limits.others.values()]
    return any(each.low <= value <= (each.high or 0) for each in ranges)


RULE = ModelRule(
    id="limited-example",
    title="An example stays within the limits of at least one device",
    why="A device accepts a frame that was published for it: limits that refuse it are wrong, or "
    "omit that device.",
    bad="level: {type: u16, limits: {usual: 0..50}}  # and an example with 100",
    good="level: {type: u16, limits: {usual: 0..100}}  # and an example with 100",
    look=_look,
)
