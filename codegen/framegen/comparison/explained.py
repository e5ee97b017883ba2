"""What explains an effect: the changes behind it, those next to it first."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from framegen.comparison.changes import CHANGE_RULES

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from framegen.comparison.changes.change import Change, Subject
    from framegen.comparison.effect import Axis, Effect
    from framegen.reading.yamltree import KeyPath

_SUBJECTS: dict[str, Subject] = {rule.id: rule.subject for rule in CHANGE_RULES}
# What cannot be behind an effect on an axis, besides mere documentation.
_BESIDE: dict[Axis, tuple[Subject, ...]] = {
    "wire": ("line", "exchange", "program"),
    "conversation": ("program",),
    "programs": (),
}
# What all messages share.
_SHARED = ("frame", "frames", "byte_order", "endpoints", "link")
# The steps of the path to a message.
_WHOLE = 2
# Words of texts that are names of nothing.
_COMMON = frozenset(
    ("is", "new", "now", "gone", "became", "renamed", "from", "messages", "it", "of", "list")
)
_NAME = re.compile(r"[A-Za-z_]\w+", re.ASCII)


def is_documentation(change: Change) -> bool:
    """Tell whether neither frames nor libraries depend on a change but for words."""
    return _SUBJECTS[change.rule] == "document"


def explain(effect: Effect, changes: Sequence[Change]) -> list[Change]:
    """Return the changes that explain an effect, the most specific first.

    They are those of its message, and of messages that it names; else those of what all messages
    share; else all. Documentation explains only what nothing else does.
    """
    telling = [each for each in changes if not is_documentation(each)]
    beside = _BESIDE[effect.axis]
    likely = [each for each in telling if _SUBJECTS[each.rule] not in beside]
    for among in (likely, telling):
        found = _near(effect, among)
        if found:
            return found
    documents = [each for each in changes if each.path[:1] != ("history",)]
    return telling or [each for each in documents if each.rule != "version-changed"] or [*changes]


def _near(effect: Effect, changes: Sequence[Change]) -> list[Change]:
    paths = [path for path in (effect.old, effect.new) if path]
    own = sorted(
        (each for each in changes if _depth(each, paths)), key=lambda each: -_depth(each, paths)
    )
    if len(effect.path) > _WHOLE:
        # What is said of this very field, if anything is.
        field = [each for each in own if _depth(each, paths) >= len(effect.path)]
        if field:
            return field
    names = _named(effect)
    named = [each for each in changes if each not in own and _message(each) & names]
    if own or named:
        return [*own, *named]
    if any(path[0] != "messages" for path in paths):
        # Such as the class of an element, which no message is called like.
        said = [each for each in changes if names & {*_NAME.findall(each.text)} - _COMMON]
        if said:
            return said
    return [each for each in changes if each.path[:1] and each.path[0] in _SHARED]


def _depth(change: Change, paths: Iterable[KeyPath]) -> int:
    """Return how near a change is to paths: the steps that they share, 0 where none is around."""
    return max((_shared(one, other) for one in _paths(change) for other in paths), default=0)


def _shared(one: KeyPath, other: KeyPath) -> int:
    least = min(len(one), len(other), _WHOLE if other[:1] == ("messages",) else 1)
    if not least or one[:least] != other[:least] or (least == 1 and other[0] == "messages"):
        return 0
    count = 0
    for step, there in zip(one, other, strict=False):
        if step != there:
            break
        count += 1
    return count


def _paths(change: Change) -> list[KeyPath]:
    return [path for path in (change.old, change.new) if path]


def _message(change: Change) -> set[str]:
    """Return the names of the message that a change belongs to."""
    return {str(path[1]) for path in _paths(change) if path[0] == "messages" and len(path) > 1}


def _named(effect: Effect) -> set[str]:
    reading = "" if effect.witness is None else effect.witness.reading
    return {*_NAME.findall(effect.text), *_NAME.findall(reading)}
