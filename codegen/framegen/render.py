"""From a spec to every file that follows from it: pure, and the same bytes wherever it runs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets import docs, python, schema, vectors

if TYPE_CHECKING:
    from framegen.model.layout import Layout
    from framegen.reading.source import Source

TARGETS = (docs, python, schema, vectors)


@dataclass(frozen=True, slots=True)
class Rendered:
    """The files, by path below the project's root, and the folders that hold nothing else."""

    files: dict[str, str]
    folders: tuple[str, ...]
    digest: str


def render(source: Source, layout: Layout) -> Rendered:
    """Everything that all targets make of a spec. Touches no disk."""
    files: dict[str, str] = {}
    for target in TARGETS:
        files |= target.render(source, layout)
    folders = (f"generated/{layout.spec.protocol.name}", docs.FOLDER)
    return Rendered(dict(sorted(files.items())), folders, source.digest)
