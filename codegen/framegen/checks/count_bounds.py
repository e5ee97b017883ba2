"""Rule: the bounds of a count are numbers of elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.language.values import Range


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            fault = None if field.count is None else _fault(field.count)
            if fault is not None:
                message_text, hint = fault
                yield Problem(("messages", name, "fields", field_name, "count"), message_text, hint)


def _fault(count: Range) -> tuple[str, str] | None:
    if count.low < 0:
        return f"a list cannot have {count.low} elements", "begin with 0 or 1"
    if count.high is not None and count.low > count.high:
        return f"the count {count} begins above its end", f"write {count.high}..{count.low}"
    if count.high == 0:
        return "a list that is always empty is no list", "remove it, or give it room"
    return None


RULE = StructureRule(
    id="count-bounds",
    title="The bounds of a count are numbers of elements",
    why="They bound what encoders accept and decoders believe; no list could have such a number "
    "of elements.",
    bad="count: 8..1",
    good="count: 1..8",
    look=_look,
)
