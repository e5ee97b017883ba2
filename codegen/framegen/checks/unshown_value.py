"""Remark: examples show every named value, both ends of a range, and negative values."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from framegen.checks.fields import numbers_of
from framegen.checks.pasted import changed, lowest, pasted
from framegen.checks.rule import ModelRule, Problem
from framegen.language.number_types import NUMBER_TYPES
from framegen.model.codec import NotAFrame, decode
from framegen.model.layout import is_constant

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    for name, message in model.messages.items():
        try:
            shown = _shown(model, message)
        except NotAFrame:
            # The rule `example` speaks of a broken example, which may be the one that shows it.
            continue
        for path, field in numbers_of(("messages", name), message.message):
            if is_constant(field):
                continue
            there = shown.get(path[3::2], set())
            for key, named in field.values.items():
                if named.value not in there:
                    text = f"no example of {name} shows `{key}`, which is {named.value}"
                    hint = partial(_hint, model, message, path, named.value)
                    yield Problem((*path, "values", key), text, hint, on_key=True)
            ends = () if field.range is None else (field.range.low, field.range.high)
            for end in dict.fromkeys(ends):
                if end is not None and end not in there:
                    text = f"no example of {name} shows {end}, an end of the range"
                    hint = partial(_hint, model, message, path, end)
                    yield Problem((*path, "range"), text, hint)
            if field.signed_as and max(there, default=0) <= NUMBER_TYPES[field.signed_as].high:
                text = f"no example of {name} shows a value that `signed_as` makes negative"
                hint = partial(_hint, model, message, path, NUMBER_TYPES[field.type].high)
                yield Problem((*path, "signed_as"), text, hint)


def _hint(model: Model, message: MessageLayout, path: KeyPath, value: int) -> str:
    """Return an example that shows the value, made of the first one that the message has."""
    examples = message.message.examples
    values = lowest(message)
    if examples:
        values = decode(model, message.direction, examples[0].hex).values
    outer, *inner = map(str, path[3::2])
    with_it = changed(values, outer, inner[0] if inner else None, value)
    example = pasted(message, with_it, f"{path[-1]} {value}")
    return (
        f"add the example {example}"
        if example
        else "add an example with it; it may be `constructed`"
    )


def _shown(model: Model, message: MessageLayout) -> dict[KeyPath, set[int]]:
    """Collect the values in the examples of a message, by field. Raises NotAFrame."""
    shown: dict[KeyPath, set[int]] = {}
    for example in message.message.examples:
        values = decode(model, message.direction, example.hex).values
        for name, value in values.items():
            for item in value if isinstance(value, list) else [value]:
                fields = item if isinstance(item, dict) else {None: item}
                for inner, number in fields.items():
                    key = (name,) if inner is None else (name, inner)
                    shown.setdefault(key, set()).add(number)
    return shown


RULE = ModelRule(
    id="unshown-value",
    title="Examples show every named value, both ends of a range, and negative values",
    why="Values at the ends of a range show a wrong width or a wrong sign. Protocols of many "
    "values have no frame for each, so this is a remark.",
    bad="level: {type: u8, range: 0..100}  # and examples with 50 alone",
    good="level: {type: u8, range: 0..100}  # and examples with 0 and 100",
    look=_look,
)
