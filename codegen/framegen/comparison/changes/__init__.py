"""The kinds of changes between two editions, one file each, and the function that finds them."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.comparison.changes.change import Change, ChangeRule
    from framegen.comparison.pair import Pair

CHANGE_RULES: tuple[ChangeRule, ...] = ()


def changes(pair: Pair) -> list[Change]:
    """Explain what became of what, in the order of the new edition; what is gone comes last."""
    return [change for rule in CHANGE_RULES for change in rule.look(pair)]
