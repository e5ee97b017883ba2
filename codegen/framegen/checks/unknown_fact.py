"""Rule: every erratum and every unknown names something that exists."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.model.codec import NotAFrame
from framegen.model.facts import NoSuchFact, look_up

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Concern
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


def _look(model: Model) -> Iterator[Problem]:
    for index, erratum in enumerate(model.spec.errata):
        path = ("errata", index, "concerns")
        yield from _missing(model, path, erratum.concerns, needs_value=True)
    for index, unknown in enumerate(model.spec.unknowns):
        path = ("unknowns", index, "concerns")
        yield from _missing(model, path, unknown.concerns, needs_value=False)


def _missing(
    model: Model, path: KeyPath, concerns: Concern, *, needs_value: bool
) -> Iterator[Problem]:
    try:
        fact = look_up(model, concerns)
    except NoSuchFact as error:
        yield Problem((*path, error.key), str(error), error.hint)
    except NotAFrame:
        # The rule `example` speaks of it.
        return
    else:
        if needs_value and fact.value is None:
            yield Problem(
                path,
                "an erratum is about one fact, and this names none",
                "add `fact`, `parameter`, or `example` with `field`",
            )


RULE = ModelRule(
    id="unknown-fact",
    title="Every erratum and every unknown names something that exists",
    why="A statement about a field that was renamed or removed is a statement about nothing.",
    bad="concerns: {message: LampSet, field: precent}",
    good="concerns: {message: LampSet, field: percent}",
    look=_look,
)
