"""Rule: every erratum names a difference between the document and the frames."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.model.codec import NotAFrame
from framegen.model.facts import Fact, NoSuchFact, look_up

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    for index, erratum in enumerate(model.spec.errata):
        try:
            fact = look_up(model, erratum.concerns)
        except (NoSuchFact, NotAFrame):
            # The rules `unknown-fact` and `example` speak of these.
            continue
        if fact.value is None:
            continue
        if fact.agrees(erratum.document):
            yield Problem(
                ("errata", index, "document"),
                f"the erratum is out of date: this spec says `{fact}`, as the document does",
                "remove the erratum, or mend what it is about",
            )
        elif not fact.agrees(erratum.bytes_):
            said = Fact(erratum.bytes_)
            yield Problem(("errata", index, "bytes"), f"this spec says `{fact}`, not `{said}`")


RULE = ModelRule(
    id="erratum",
    title="Every erratum names a difference between the document and the frames",
    why="An erratum is a claim about bytes, and is checked like an example. Once the spec agrees "
    "with the document, it is out of date.",
    bad="{document: 11, bytes: 11}",
    good="{document: 11, bytes: 15}",
    look=_look,
)
