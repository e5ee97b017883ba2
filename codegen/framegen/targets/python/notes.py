"""Notes as docstrings have them: what else is known, each with its source."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.language.spec import Note, Spec


def noted(notes: Iterable[Note], spec: Spec) -> list[str]:
    """Return each note with its source behind it."""
    return [f"{note.text} ({spec.sources[note.cite.source].title})" for note in notes]
