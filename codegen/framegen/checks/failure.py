"""Rule: what says that a request has failed is a number of the reply."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.field_values import values_of
from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import NumberField
from framegen.language.values import Range
from framegen.model.exchanges import arguments_of
from framegen.model.layout import is_list
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import AnyField, Message, Spec


def _look(spec: Spec) -> Iterator[Problem]:
    replies = {message.reply for message in spec.messages.values()}
    for name, message in spec.messages.items():
        if message.failure is None:
            continue
        here, field = ("messages", name, "failure"), message.failure.field
        numbers = [key for key in arguments_of(message) if _is_number(message.fields[key])]
        if field not in numbers:
            yield Problem(here, *_no_number(name, message, field, numbers))
        elif name not in replies:
            what = f"{name} is the reply to nothing, so nothing has failed"
            hint = "name it as the `reply` of a request, or leave out `failure`"
            yield Problem(here, what, hint, on_key=True)
        elif never := _never_good(message.fields[field], message.failure.good):
            what = f"`{field}` is never {message.failure.good}, so that every {name} has failed"
            hint = f"name its value where nothing has, `{field} unless {never.low}`: it has {never}"
            yield Problem(here, what, hint)


def _no_number(name: str, message: Message, field: str, numbers: list[str]) -> tuple[str, str]:
    if field in message.fields:
        return f"`{field}` is no whole number that a frame tells", did_you_mean(field, numbers)
    return f"{name} has no field `{field}`", did_you_mean(field, numbers)


def _never_good(field: AnyField, good: int) -> Range | None:
    """Return the values of a field, if the good one is not among them."""
    values = values_of(field)
    return None if values is None or values.holds(Range.only(good)) else values


def _is_number(field: AnyField) -> bool:
    if not isinstance(field, NumberField) or is_list(field) or field.text is not None:
        return False
    type_ = NUMBER_TYPES.get(field.type)
    return type_ is None or not type_.is_float


RULE = StructureRule(
    id="failure",
    title="What says that a request has failed is a number of the reply",
    why="A client raises a reply whose `failure` is not zero, or not the value named as the good "
    "one, with what it says.",
    bad="LampState: {failure: eror, fields: {error: {type: u8}}}",
    good="LampState: {failure: error, fields: {error: {type: u8}}}",
    look=_look,
)
