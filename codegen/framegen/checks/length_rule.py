"""Rule: the length rule of a message is the length of its fields, for every legal count."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.language.formula import Sizes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.formula import LengthRule
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for message in model.messages.values():
        fault = _fault(message)
        if fault is not None:
            path = ("messages", message.name, "length")
            yield Problem(path, fault, f"write `length: {_written(message)}`{_or(message)}")


def _written(message: MessageLayout) -> str:
    """Return the rule that follows from the fields."""
    if message.optional:
        return f"[{', '.join(map(str, message.possible))}]"
    return str(message.formula)


def _or(message: MessageLayout) -> str:
    """Return what else may have been meant."""
    if message.optional or not isinstance(message.message.length, Sizes):
        return ""
    return ", or mark the last fields `optional: true`"


def _fault(message: MessageLayout) -> str | None:
    declared, derived = message.message.length, message.formula
    if isinstance(declared, Sizes) or message.optional:
        return _sizes(message, declared)
    if declared.name is not None and declared.name != derived.name:
        if derived.name is None:
            return f"`{declared.name}` counts nothing in {message.name}, whose length is fixed"
        return f"the count of {message.name} is `{derived.name}`, not `{declared.name}`"
    # Two straight lines that agree in two places agree everywhere.
    for count in message.counts[:2]:
        if declared.at(count) != derived.at(count):
            where = "" if message.items is None else f" with {derived.name} {count}"
            return (
                f"the length rule gives {declared.at(count)}{where}, "
                f"and the fields make {derived.at(count)}"
            )
    return None


def _sizes(message: MessageLayout, declared: LengthRule) -> str | None:
    """Compare the lengths of a message whose last fields may be absent, in two ways at least."""
    if not message.optional:
        return f"several lengths are listed, and the fields make {message.formula}"
    if not isinstance(declared, Sizes):
        return f"the last fields may be absent, and `{declared}` is one length"
    possible = message.possible
    for size in declared.sizes:
        if size not in possible:
            return f"{size} is listed, and the fields make {' or '.join(map(str, possible))}"
    for size, what in ((possible[0], "without"), (possible[-1], "with")):
        if size not in declared.sizes:
            return f"the length {what} all optional fields, {size}, is not listed"
    return None


RULE = ModelRule(
    id="length-rule",
    title="The length rule of a message is the length of its fields, for every legal count",
    why="The rule is what the document says, and the fields are what the code does. If they "
    "disagree, one of them is wrong.",
    bad="length: 3 * lamp_count + 5  # and fields of 2 bytes a lamp",
    good="length: 2 * lamp_count + 5",
    look=_look,
)
