"""What most rules tell: that a key changed, or that a thing came, went or has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.comparison.changes.change import Change
from framegen.comparison.changes.wording import became, called

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from framegen.comparison.changes.things import Thing, Things, Twin

# Of so many names, the order is told.
_FEW = 6


def changed(
    rule: str, twin: Twin[Any], key: str, old: object, new: object, what: str = ""
) -> Iterator[Change]:
    """Yield what became of a key, if anything did; `what` is its name in words."""
    if old != new:
        text = f"{called(twin.new_path)}: {became(what, old, new)}"
        yield Change(rule, (*twin.old_path, key), (*twin.new_path, key), text.removeprefix(": "))


def switched(
    rule: str, twin: Twin[Any], key: str, old: bool, new: bool, words: tuple[str, str]
) -> Iterator[Change]:
    """Yield that something is so now, or is not any more: `words` are for no and for yes."""
    if old != new:
        text = f"{called(twin.new_path)} {words[new]}"
        yield Change(rule, (*twin.old_path, key), (*twin.new_path, key), text)


def added(
    rule: str, things: Things[Any], what: Callable[[Thing[Any]], str] | None = None
) -> Iterator[Change]:
    """Yield what is new."""
    for each in things.added:
        said = "" if what is None else f": {what(each)}"
        yield Change(rule, None, each.path, f"{called(each.path)} is new{said}")


def removed(
    rule: str, things: Things[Any], what: Callable[[Thing[Any]], str] | None = None
) -> Iterator[Change]:
    """Yield what is gone."""
    for each in things.removed:
        said = "" if what is None else f": {what(each)}"
        yield Change(rule, each.path, None, f"{called(each.path)} is gone{said}")


def renamed(rule: str, things: Things[Any]) -> Iterator[Change]:
    """Yield what has another name for certain."""
    for each in things.twins:
        if each.is_renamed and not each.guessed:
            text = f"{called(each.new_path)}: renamed from {each.old_path[-1]}"
            yield Change(rule, each.old_path, each.new_path, text)


def moved(rule: str, things: Things[Any]) -> Iterator[Change]:
    """Yield what has its things in another order."""
    for each in things.moved:
        order = "in another order"
        if len(each.new) <= _FEW:
            order = f"order {', '.join(each.old)} became {', '.join(each.new)}"
        yield Change(rule, each.old_path, each.new_path, f"{called(each.new_path)}: {order}")
