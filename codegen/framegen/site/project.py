"""What a site is made of: specs, guides and files. All that is read from the disk is read here."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable
from framegen.site.editions.released import read_released
from framegen.site.guides.linked_files import linked_files, pictures
from framegen.site.guides.plan import README, Plan
from framegen.site.look import Look, read_look
from framegen.targets.filenames import file_stem

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence
    from pathlib import Path

    from framegen.comparison.edition import Edition
    from framegen.compile import Compiled

# Where the references lie among the guides, as Markdown.
_REFERENCES = "reference"
_VERSION = re.compile(r'^version *= *"([^"]+)"', re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Project:
    """The specs of a site, its guides in Markdown by path, and other files that these show.

    Paths are below the folder of the guides. `base` is the address where the site will be, for
    links that must be whole; "" where nobody knows it. `version` is that of the project, if it
    has any. `released` are the released editions of each protocol, the newest first. `folder` is
    that of the guides, as it was given. `look` is what docs/site.yaml says.
    """

    specs: Sequence[Compiled]
    guides: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)
    base: str = ""
    version: str = ""
    released: Mapping[str, Sequence[Edition]] = field(default_factory=dict)
    folder: str = "docs"
    look: Look = field(default_factory=Look)


def read_project(
    specs: Mapping[Path, Compiled],
    docs: Path | None = None,
    base: str = "",
    settings: Path | None = None,
) -> Project:
    """Read what was released of specs, by their files, and the guides below a folder.

    With the guides come others that their README lists, the pictures in them, and the files that
    they link to. The look of the site is that of the folder `settings`, or of the guides. Raises
    Unusable, with the name of the file.
    """
    names = {file: compiled.spec.protocol.name for file, compiled in specs.items()}
    _refuse_twins(names)
    editions = {name: read_released(file, name) for file, name in names.items()}
    folder = settings or docs
    look = Look() if folder is None else read_look(folder)
    if docs is None:
        compiled = [*specs.values()]
        return Project(compiled, {}, look.pictures, base, released=editions, look=look)
    guides = {path: _text(docs / path) for path in _guides(docs, names.values())}
    guides |= _listed(docs, Plan(guides[README]))
    files = {**pictures(docs), **linked_files(guides, docs), **look.pictures}
    version, shown = _version(docs.parent), docs.as_posix()
    return Project([*specs.values()], guides, files, base, version, editions, shown, look)


def _refuse_twins(names: Mapping[Path, str]) -> None:
    """Refuse two specs of one name: the pages of one would replace those of the other."""
    first: dict[str, Path] = {}
    for file, name in names.items():
        if first.setdefault(name, file) is not file:
            raise Unusable(
                f"{visible(first[name].name)} and {visible(file.name)} are both of the protocol "
                f"{visible(name)}",
                hint="give one of them another `protocol: name:`, or name the one to be shown",
            )


def _guides(docs: Path, protocols: Collection[str]) -> Iterator[str]:
    """Yield the paths of all guides below a folder, but for the references that are made there."""
    made = {(_REFERENCES, file_stem(name)) for name in protocols}
    for file in sorted(docs.rglob("*.md")):
        steps = file.relative_to(docs).parts
        if steps[:2] in made or any(step.startswith(".") for step in steps):
            continue
        path = "/".join(steps)
        if re.search(r"[#?%\\]", path):
            raise Unusable(
                f"{visible(file.as_posix())} has a character in its name that no link can lead to",
                hint="name it without #, ?, % and \\",
            )
        yield path


def _listed(docs: Path, plan: Plan) -> Iterator[tuple[str, str]]:
    """Yield what the plan lists of the project beside its guides, such as ../CHANGELOG.md."""
    root = docs.parent.resolve()
    for section in plan.sections:
        for entry in section.entries:
            file = (docs / entry.link).resolve()
            outside = entry.link.startswith("../") and entry.link.endswith(".md")
            if outside and file.is_file() and file.is_relative_to(root):
                yield entry.link, _text(file)


def _version(root: Path) -> str:
    """Return the version of a Python project, which pyproject.toml has; "" for any other."""
    file = root / "pyproject.toml"
    found = _VERSION.search(file.read_text(encoding="utf-8")) if file.is_file() else None
    return "" if found is None else found[1]


def _text(file: Path) -> str:
    try:
        return file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unusable(
            f"{visible(file.as_posix())} is not UTF-8 text: byte {error.start}",
            hint="save it as UTF-8",
        ) from None
    except OSError as error:
        raise Unusable(f"{visible(file.as_posix())} cannot be read: {error.strerror}") from None
