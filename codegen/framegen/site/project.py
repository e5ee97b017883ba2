"""What a site is made of: specs, guides and files. All that is read from the disk is read here."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from framegen.compile import Compiled


@dataclass(frozen=True, slots=True)
class Project:
    """The specs of a site, its guides in Markdown by path, and other files that these show.

    `base` is the address where the site will be, for links that must be whole; "" where nobody
    knows it.
    """

    specs: Sequence[Compiled]
    guides: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)
    base: str = ""


def read_project(specs: Sequence[Compiled], docs: Path | None, base: str = "") -> Project:
    """Read the guides below a folder, and the pictures in them."""
    if docs is None:
        return Project(specs, base=base)
    guides = {file.name: file.read_text(encoding="utf-8") for file in sorted(docs.glob("*.md"))}
    files = {
        file.relative_to(docs).as_posix(): file.read_bytes()
        for file in sorted((docs / "images").glob("*"))
    }
    return Project(specs, guides, files, base)
