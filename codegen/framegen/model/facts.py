"""Facts of a spec, looked up so that errata and unknowns can be compared with them."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from framegen.language.formula import Formula, Sizes, parse_formula
from framegen.language.spec import ListField
from framegen.model.codec import decode
from framegen.model.slots import Number
from framegen.reading.findings import did_you_mean, slip_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from framegen.language.spec import Concern, Message
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


class NoSuchFact(ValueError):  # noqa: N818 - says what the fact is
    """A fact that the spec does not have; `key` is the wrong key of the concern."""

    def __init__(self, key: str, message: str, hint: str | Callable[[], str] = "") -> None:
        super().__init__(message)
        self.key = key
        self.hint = hint


@dataclass(frozen=True, slots=True)
class Fact:
    """A fact of the spec; None where the subject exists but has no single value."""

    value: int | str | list[Any] | Formula | Sizes | None

    def __str__(self) -> str:
        return json.dumps(self.value) if isinstance(self.value, list) else str(self.value)

    def agrees(self, said: object) -> bool:
        """Tell whether `said` is the same; a length rule may be spaced and ordered differently."""
        if isinstance(self.value, Sizes):
            return list(self.value.sizes) == said
        if not isinstance(self.value, Formula):
            # As JSON, 1 and true differ.
            return json.dumps(self.value, sort_keys=True) == json.dumps(said, sort_keys=True)
        try:
            return self.value == parse_formula(str(said))
        except ValueError:
            return False


def _other_message(name: str, messages: Iterable[str]) -> str:
    """Hint at the message that was meant; one that was removed has no facts any more."""
    near = slip_of(name, messages)
    return f"did you mean `{near}`?" if near else "if it was removed, remove what is said of it"


def look_up(model: Model, concern: Concern) -> Fact:
    """Find a fact. Raises NoSuchFact; and codec.NotAFrame where it is in a broken example."""
    message = model.messages.get(concern.message)
    if message is None:
        raise NoSuchFact(
            "message",
            f"there is no message `{concern.message}`",
            partial(_other_message, concern.message, model.messages),
        )
    chosen = [key for key in ("fact", "parameter", "example") if getattr(concern, key) is not None]
    if len(chosen) > 1:
        raise NoSuchFact(chosen[1], f"`{chosen[0]}` and `{chosen[1]}` are two facts, not one")
    if concern.field is not None and chosen not in ([], ["example"]):
        raise NoSuchFact("field", f"`{chosen[0]}` and `field` are two facts, not one")
    if concern.fact is not None:
        return _of_message(model, message, concern.fact)
    if concern.parameter is not None:
        return Fact(_parameter(message, concern.parameter))
    if concern.example is not None:
        return _of_example(model, message, concern.example, concern.field)
    if concern.field is not None:
        _require_field(message.message, concern.message, concern.field)
    return Fact(None)


def _of_message(model: Model, message: MessageLayout, fact: str) -> Fact:
    if fact == "id":
        return Fact(message.ids[0] if len(message.ids) == 1 else list(message.ids))
    if fact == "kind":
        return Fact(model.kind(message.name))
    return Fact(message.message.length)


def _of_example(model: Model, message: MessageLayout, number: int, field: str | None) -> Fact:
    examples = message.message.examples
    if number > len(examples):
        raise NoSuchFact(
            "example", f"{message.name} has no example {number}: it has {len(examples)}"
        )
    if field is None:
        return Fact(None)
    data = examples[number - 1].hex
    values = decode(model, message.direction, data).values
    if field in values:
        return Fact(values[field])
    if field == "length":
        return Fact(len(data) - message.frame.uncounted)
    raise NoSuchFact(
        "field",
        f"the examples of {message.name} give no field `{field}`",
        did_you_mean(field, [*values, "length"]),
    )


def _require_field(message: Message, name: str, path: str) -> None:
    outer, _, inner = path.partition(".")
    field = message.fields.get(outer)
    known = list(message.fields)
    if inner and isinstance(field, ListField):
        known = [f"{outer}.{each}" for each in field.fields]
    if field is None or (inner and path not in known):
        raise NoSuchFact("field", f"{name} has no field `{path}`", did_you_mean(path, known))


def _parameter(message: MessageLayout, number: int) -> str:
    """Name parameter byte `number`, counted from 1: `times, low byte`."""
    at = message.frame.body_at + number - 1
    for placed in message.lay_out(message.counts[-1]):
        if isinstance(placed.slot, Number) and placed.slot.is_field and at < placed.end:
            return _byte(placed.path, placed.slot, at - placed.at)
    most = message.largest - message.frame.least
    raise NoSuchFact(
        "parameter", f"{message.name} has no parameter byte {number}: it has {most} at most"
    )


def _byte(path: str, number: Number, offset: int) -> str:
    """Name one byte of a number, the lowest being byte 0: `time_ms, low byte`."""
    if number.size == 1:
        return path
    rank = offset if number.order == "little" else number.size - 1 - offset
    if number.size == 2:
        return f"{path}, {('low', 'high')[rank]} byte"
    return f"{path}, bits {8 * rank}..{8 * rank + 7}"
