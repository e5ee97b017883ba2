"""What explains an effect, what version is due, and the lines of an entry for the history."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.comparison.changes.change import Change
    from framegen.comparison.comparison import Comparison
    from framegen.comparison.effect import Effect

Bump: TypeAlias = Literal["major", "minor", "patch"]


def due(effects: Sequence[Effect], changes: Sequence[Change]) -> Bump | None:
    """Return the bump that is due."""
    if any(effect.breaks for effect in effects):
        return "major"
    return "minor" if effects else "patch" if changes else None


def version_finding(old: str, new: str, bump: Bump | None) -> str | None:
    """Say what is wrong with a version."""
    if bump is None or old != new:
        return None
    return f"a {bump} version is due after {old}, and it is still {new}"


def explain(effect: Effect, changes: Sequence[Change]) -> list[Change]:
    """Return the changes that explain an effect: those of its message, or of what all share."""
    paths = [path[:2] for path in (effect.old, effect.new) if path]
    found = [c for c in changes if any(path[:2] in paths for path in (c.old, c.new) if path)]
    return found or [c for c in changes if c.path[:1] != ("messages",)]


def sentences(comparison: Comparison) -> list[str]:
    """Return the lines of `changes`."""
    return [change.text for change in comparison.changes] or [e.text for e in comparison.effects]
