"""Rule: the field that says how long a motion lasts is a time, and is given by the client."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import NumberField
from framegen.model.exchanges import STEPS_PER_SECOND, arguments_of
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message
    from framegen.language.values import Direction
    from framegen.model.model import Model

_UNITS = " or ".join(f"`unit: {unit}`" for unit in reversed(STEPS_PER_SECOND))


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.spec.messages.items():
        if message.lasts is None:
            continue
        found = _misuse(name, message, model.roles.sent) or _no_time(name, message, message.lasts)
        if found is not None:
            yield Problem(("messages", name, "lasts"), *found)


def _misuse(name: str, message: Message, sent: Direction) -> tuple[str, str] | None:
    """Say why a client cannot wait for the end of what the message starts."""
    if message.direction != sent:
        what = f"{name} goes {message.direction}, and a client sends {sent}"
        return what, "only what a client sends can be waited for"
    if message.reply is not None:
        what = f"{name} is answered by {message.reply}, and that is what a client returns"
        return what, "leave out `lasts`, or the reply"
    return None


def _no_time(name: str, message: Message, lasts: str) -> tuple[str, str] | None:
    """Say why the field is not a time."""
    times = [each for each in arguments_of(message) if _is_time(message, each)]
    field = message.fields.get(lasts)
    if field is None or lasts not in arguments_of(message):
        return f"{name} has no argument `{lasts}`", did_you_mean(lasts, times)
    if not isinstance(field, NumberField) or field.counted_by is not None:
        return f"`{lasts}` is a list, and not one time", did_you_mean(lasts, times)
    if field.unit not in STEPS_PER_SECOND:
        return f"`{lasts}` has no unit of time", f"give it {_UNITS}, or name another field"
    type_ = NUMBER_TYPES.get(field.type)
    lowest = field.range.low if field.range is not None else 0 if type_ is None else type_.low
    if lowest < 0:
        what = f"`{lasts}` may be negative, and a time is not"
        return what, "use an unsigned type, or a `range` from 0 on"
    return None


def _is_time(message: Message, name: str) -> bool:
    field = message.fields[name]
    if not isinstance(field, NumberField) or field.counted_by is not None:
        return False
    return field.unit in STEPS_PER_SECOND


RULE = ModelRule(
    id="lasts",
    title="The field that says how long a motion lasts is a time, and is given by the client",
    why="A client adds it to the time at which the message has left, and waits until then: "
    "without a known unit, or below zero, there is nothing to wait for.",
    bad="LampFade: {lasts: level}",
    good="LampFade: {lasts: fade_ms}",
    look=_look,
)
