"""Notes: what else is known of a thing, each with its source."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets.docs.cite import CiteView, cite_view

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.language.spec import Note, Spec


@dataclass(frozen=True, slots=True)
class NoteView:
    """A further fact, and its source."""

    text: str
    cite: CiteView


def note_views(spec: Spec, notes: Iterable[Note]) -> list[NoteView]:
    """Return each note with its source."""
    return [NoteView(note.text, cite_view(spec, note.cite)) for note in notes]
