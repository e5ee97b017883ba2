"""The library of an edition, as its target renders it, with examples that surely fit."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING

from framegen.comparison.edges import values_to_try
from framegen.language.spec import Example
from framegen.model.codec import encode
from framegen.render import render_target
from framegen.targets import python

if TYPE_CHECKING:
    from framegen.comparison.edition import Edition
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@lru_cache(maxsize=2)
def rendered(edition: Edition) -> dict[str, str] | None:
    """Return the files of an edition's library, by path below its package.

    None where an edition contradicts itself so that nothing can be made of it.
    """
    try:
        model = _with_examples(edition.model)
        files = render_target(python.TARGET, replace(edition.compiled, findings=[], derived=model))
    except Exception:  # noqa: BLE001 - whatever a spec that breaks rules runs into
        return None
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
    given = {name: value for name, value in values.items() if value is not None}
    shown = encode(layout, values).hex(" ")
    example = Example.model_validate(
        {"title": "One", "hex": shown, "values": given, "constructed": "its edges"}
    )
    message = layout.message.model_copy(update={"examples": [example]})
    return replace(layout, message=message)
