"""The library of an edition, as its target renders it, with examples that surely fit."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from framegen.checks import EVIDENCE_RULES
from framegen.comparison.edges import values_to_try
from framegen.language.spec import Example
from framegen.model.codec import encode
from framegen.render import render_target
from framegen.targets import python

if TYPE_CHECKING:
    from framegen.comparison.edition import Edition
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.findings import Finding

# What examples and documents say is not in the way of a library.
_BESIDE = frozenset(rule.id for rule in EVIDENCE_RULES)


class NoLibrary(Exception):  # noqa: N818 - says what cannot be made
    """An edition contradicts itself, so that no library can be made of it; `finding` says how."""

    def __init__(self, finding: Finding) -> None:
        super().__init__(finding.message)
        self.finding = finding


@lru_cache(maxsize=2)
def rendered(edition: Edition) -> dict[str, str]:
    """Return the files of an edition's library, by path below its package. Raises NoLibrary."""
    try:
        model = _with_examples(edition.model)
        files = render_target(python.TARGET, replace(edition.compiled, findings=[], derived=model))
    except Exception as error:
        # What a rule is there to prevent may have any consequence; nothing else may.
        tolerated = edition.compiled.tolerated
        finding = next((each for each in tolerated if each.rule not in _BESIDE), None)
        if finding is None:
            raise
        raise NoLibrary(finding) from error
    (folder,) = python.TARGET.folders(model)
    return {path.removeprefix(f"{folder}/"): text for path, text in files.items()}


def _with_examples(model: Model) -> Model:
    """Return a model with one example for each message: no program depends on the author's."""
    messages = {name: _with_example(layout) for name, layout in model.messages.items()}
    written = {name: layout.message for name, layout in messages.items()}
    spec = model.spec.model_copy(update={"messages": written})
    return replace(model, spec=spec, messages=messages)


def _with_example(layout: MessageLayout) -> MessageLayout:
    values = next(values_to_try(layout, None, {}, pairs=False))
    shown = encode(layout, values).hex(" ")
    example = Example.model_validate(
        {"title": "One", "hex": shown, "values": values, "constructed": "its edges"}
    )
    message = layout.message.model_copy(update={"examples": [example]})
    return replace(layout, message=message)
