"""What a site is made of: specs, guides and files. All that is read from the disk is read here."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framegen.site.plan import README, Plan

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence
    from pathlib import Path

    from framegen.compile import Compiled

_VERSION = re.compile(r'^version *= *"([^"]+)"', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Project:
    """The specs of a site, its guides in Markdown by path, and other files that these show.

    Paths are below the folder of the guides. `base` is the address where the site will be, for
    links that must be whole; "" where nobody knows it. `version` is that of the project, if it
    has any.
    """

    specs: Sequence[Compiled]
    guides: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)
    base: str = ""
    version: str = ""


def read_project(specs: Sequence[Compiled], docs: Path | None, base: str = "") -> Project:
    """Read the guides below a folder, others that their README lists, and the pictures in them."""
    if docs is None:
        return Project(specs, base=base)
    guides = {file.name: file.read_text(encoding="utf-8") for file in sorted(docs.glob("*.md"))}
    guides |= _listed(docs, Plan(guides[README]))
    files = {
        file.relative_to(docs).as_posix(): file.read_bytes()
        for file in sorted((docs / "images").glob("*"))
    }
    return Project(specs, guides, files, base, _version(docs.parent))


def _listed(docs: Path, plan: Plan) -> Iterator[tuple[str, str]]:
    """Yield what the plan lists of the project beside its guides, such as ../CHANGELOG.md."""
    root = docs.parent.resolve()
    for section in plan.sections:
        for entry in section.entries:
            file = (docs / entry.link).resolve()
            outside = entry.link.startswith("../") and entry.link.endswith(".md")
            if outside and file.is_file() and file.is_relative_to(root):
                yield entry.link, file.read_text(encoding="utf-8")


def _version(root: Path) -> str:
    """Return the version of a Python project, which pyproject.toml has; "" for any other."""
    file = root / "pyproject.toml"
    found = _VERSION.search(file.read_text(encoding="utf-8")) if file.is_file() else None
    return "" if found is None else found[1]
