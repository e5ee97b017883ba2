"""The entry of a version in the history of its spec: what changed, in sentences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.comparison.changes import CHANGE_RULES
from framegen.comparison.changes.wording import called
from framegen.comparison.due import tells_versions, warns

if TYPE_CHECKING:
    from framegen.comparison.changes.change import Change
    from framegen.comparison.comparison import Comparison

_DOCUMENTS = frozenset(rule.id for rule in CHANGE_RULES if rule.subject == "document")
_EXAMPLE = "example-changed"
# As many of those that no user notices are told one by one.
_MOST_WORDS = 3


def sentences(comparison: Comparison, *, examples: bool = True) -> list[str]:
    """Return the lines of `changes` for the new edition: first what users notice.

    Of changes without any effect, only some are told one by one. Without `examples`, those whose
    bytes follow what else changed are left out.
    """
    effects = comparison.effects
    paths = [path for each in effects for path in (each.old, each.new) if path is not None]
    noticed, words, following = list[str](), list[str](), list[str]()
    for change in comparison.changes:
        here = change.path
        if tells_versions(here):
            continue
        near = any(here[: len(path)] == path or path[: len(here)] == here for path in paths)
        told = warns(change) or (near and change.rule not in _DOCUMENTS)
        follows = not examples and change.rule == _EXAMPLE
        (noticed if told else following if follows else words).append(sentence(_text(change)))
    if not noticed:
        noticed = [sentence(effect.text) for effect in effects]
    if not noticed and not words:
        words = following
    noticed, words = [*dict.fromkeys(noticed)], [*dict.fromkeys(words)]
    if len(words) > _MOST_WORDS:
        words = [f"{pluralize(len(words), 'change')} of words, sources or examples."]
    return [*noticed, *words]


def _text(change: Change) -> str:
    """Return what became of something; what is not said to be renamed is gone, once released."""
    if change.rule == "maybe-renamed" and change.old is not None and change.new is not None:
        return f"{called(change.old)} is gone, and {called(change.new)} is new"
    return change.text


def sentence(text: str) -> str:
    """Return a text on one line, with a full stop."""
    text = " ".join(text.split())
    return text if text.endswith((".", "!", "?")) else f"{text}."
