"""Titles of what became of one message, or of several to which the same happened."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.comparison.report.view import Section, View

# So many names of messages in one line.
_MOST_NAMES = 4


def group_title(view: View, group: Sequence[Section]) -> str:
    """Return what a group of sections is about: `LampDim (was LampFade)`."""
    if len(group) > 1:
        names = shortened_list([each.title for each in group])
        return f"{pluralize(len(group), 'message')}: {names}"
    title = group[0].title
    if not title:
        return "all messages"
    fate = fate_of(view, title)
    return f"{title} ({fate})" if fate else title


def fate_of(view: View, title: str) -> str:
    """Return what became of a message as a whole: `new`, `gone`, `was LampFade`, or nothing."""
    before = view.pair.messages.to_old.get(title)
    if title in view.pair.messages.added and title in view.new.spec.messages:
        return "new"
    if title not in view.new.spec.messages:
        return "gone"
    if before in (None, title):
        return ""
    was = "may be" if before in view.pair.messages.guessed else "was"
    return f"{was} {before}"


def shortened_list(names: Sequence[str]) -> str:
    """Return some names in one line, and how many more there are."""
    shown = ", ".join(names[:_MOST_NAMES])
    more = len(names) - _MOST_NAMES
    return f"{shown} and {more} more" if more > 0 else shown
