"""What a site is made of: specs, guides and files. All that is read from the disk is read here."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framegen.comparison.listing import edition_of, released
from framegen.console import visible
from framegen.language.load import read_source
from framegen.reading.yamltree import Unusable
from framegen.site.linked_files import linked_files

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from pathlib import Path

    from framegen.comparison.edition import Edition
    from framegen.compile import Compiled

_KEPT = "a released edition stays as it was: take it from the history of the project again"


@dataclass(frozen=True, slots=True)
class Project:
    """The specs of a site, its guides in Markdown by path, and other files that these show.

    `base` is the address where the site will be, for links that must be whole; "" where nobody
    knows it. `released` are the released editions of each protocol, the newest first.
    """

    specs: Sequence[Compiled]
    guides: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)
    base: str = ""
    released: Mapping[str, Sequence[Edition]] = field(default_factory=dict)


def read_project(
    specs: Mapping[Path, Compiled], docs: Path | None = None, base: str = ""
) -> Project:
    """Read the released editions of specs, by file, and the guides below a folder.

    With the guides come their pictures, and the files beside them that they link to. Raises
    Unusable, with the name of the file.
    """
    editions = {
        each.spec.protocol.name: read_released(file, each.spec.protocol.name)
        for file, each in specs.items()
    }
    guides, files = ({}, {}) if docs is None else _read_guides(docs)
    return Project([*specs.values()], guides, files, base, editions)


def read_released(spec: Path, name: str) -> list[Edition]:
    """Read the released editions of a protocol, the newest first. Raises Unusable."""
    return [_read_edition(file) for file in released(spec.parent, name)]


def _read_edition(file: Path) -> Edition:
    source = read_source(file)
    edition = edition_of(source)
    said = f"{edition.spec.protocol.name}-{edition.version}"
    if said != file.stem:
        raise Unusable(
            f"{source.name} says that it is {visible(said)}, and its name is {visible(file.stem)}",
            hint=_KEPT,
        )
    return edition


def _read_guides(docs: Path) -> tuple[dict[str, str], dict[str, bytes]]:
    guides = {file.name: _text(file) for file in sorted(docs.glob("*.md"))}
    pictures = {
        file.relative_to(docs).as_posix(): file.read_bytes()
        for file in sorted((docs / "images").glob("*"))
    }
    return guides, pictures | linked_files(guides, docs)


def _text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise Unusable(
            f"{visible(file.as_posix())} is not UTF-8 text: byte {error.start}",
            hint="save it as UTF-8",
        ) from None
    except OSError as error:
        raise Unusable(f"{visible(file.as_posix())} cannot be read: {error.strerror}") from None
