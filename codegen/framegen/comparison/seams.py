"""What explains an effect."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.comparison.changes.change import Change
    from framegen.comparison.effect import Effect


def explain(effect: Effect, changes: Sequence[Change]) -> list[Change]:
    """Return the changes that explain an effect: those of its message, or of what all share."""
    paths = [path[:2] for path in (effect.old, effect.new) if path]
    found = [c for c in changes if any(path[:2] in paths for path in (c.old, c.new) if path)]
    return found or [c for c in changes if c.path[:1] != ("messages",)]
