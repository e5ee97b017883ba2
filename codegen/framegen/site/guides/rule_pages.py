"""The pages about kinds of changes: the guide that has a heading for each rule of `diff`."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from framegen.comparison.changes import CHANGE_RULES

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.site.guides.guide import Guide

_RULES = frozenset(rule.id for rule in CHANGE_RULES)


def rule_pages(guides: Sequence[Guide]) -> dict[str, str]:
    """Return where each rule is explained, below the root of the site.

    Many rules are called by a common word, so a guide counts if most of them are in it.
    """
    for guide in guides:
        found = {
            inside.content: f"{guide.page}#{before.attrGet('id')}"
            for before, inside in pairwise(guide.tokens)
            if before.type == "heading_open" and inside.content in _RULES
        }
        if len(found) > len(_RULES) / 2:
            return found
    return {}
