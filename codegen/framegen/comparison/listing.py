"""Listings: the specs that a state of the project has, as it lies here or at a revision."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.comparison.edition import Edition
from framegen.comparison.partners import Listed
from framegen.comparison.revision import NotInRevision, Revision
from framegen.compile import compile_leniently, placed
from framegen.language.load import read_source
from framegen.language.version import Version
from framegen.model.layout import LONGEST
from framegen.project import FOLDER, all_specs
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from framegen.reading.source import Source

# Below the folder of the spec.
RELEASED = "released"


def edition_of(source: Source) -> Edition:
    """Read an edition, whatever today's rules say of it.

    Raises Unusable where it has no model, or frames too long to be looked at.
    """
    try:
        compiled = compile_leniently(source)
    except Unusable as error:
        raise placed(error, source) from None
    model = compiled.model
    for message in model.messages.values():
        # Frames are made of what it allows, to be compared: these would not fit into memory.
        if message.largest > LONGEST:
            raise Unusable(
                f"{source.name}: {message.name} has frames of up to {message.largest} bytes, and "
                f"no frame may have more than {LONGEST}",
                hint="bound its list by `count:`",
            )
    # So that what is made of two editions does not differ by where they are from.
    path = f"spec/{model.spec.protocol.name}.yaml"
    compiled = replace(compiled, source=replace(compiled.source, path=path))
    return Edition(source.name, compiled, model.spec, model)


def working_edition(spec: Path) -> Edition:
    """Read a spec as it lies here. Raises Unusable."""
    return edition_of(read_source(spec))


def released(folder: Path, name: str) -> list[Path]:
    """Return the released editions of a protocol, the newest first; its spec is in `folder`."""
    versions: dict[Path, Version] = {}
    for file in (folder / RELEASED).glob("*.yaml"):
        version = Version.parse_or_none(file.stem.removeprefix(f"{name}-"))
        if version is not None and file.stem != str(version):
            versions[file] = version
    return sorted(versions, key=versions.__getitem__, reverse=True)


def kept_before(folder: Path, old: Edition) -> list[Listed]:
    """Return the editions that are kept from before another, or from its time, the newest first.

    What leads up to a version promises nothing.
    """
    name, version = old.spec.protocol.name, Version.parse_or_none(old.version)
    found: list[Listed] = []
    for file in released(folder, name):
        its = Version.parse_or_none(file.stem.removeprefix(f"{name}-"))
        is_before = its is not None and its.is_final and (version is None or its <= version)
        if is_before and visible(file.as_posix()) != old.label:
            read = partial(working_edition, file)
            found.append(Listed(file.as_posix(), file.name, read, name))
    return found


def specs_here() -> list[Listed]:
    """Return the specs of the project as they lie here."""
    try:
        return specs_beside(*all_specs())
    except Unusable:
        return []


def specs_beside(*specs: Path) -> list[Listed]:
    """Return specs as they lie here, and those beside the first."""
    every = sorted({*specs, *specs[0].parent.glob("*.yaml")})
    return [Listed(each.as_posix(), each.name, partial(working_edition, each)) for each in every]


def earlier_specs(later: list[Listed], spec: Path | None) -> list[Listed]:
    """Return what a spec and those beside it are compared with unless something is named.

    It is the newest released edition of each protocol, and of the others what the last commit has.
    """
    folder = Path(FOLDER) if spec is None else spec.parent
    stems = sorted(file.stem for file in (folder / RELEASED).glob("*.yaml"))
    names = dict.fromkeys(stem.partition("-")[0] for stem in stems)
    newest = {name: files for name in names if (files := released(folder, name))}
    try:
        committed = specs_at(Revision("HEAD", Path() if spec is None else folder_of(spec)))
    except NotInRevision:
        committed = []
    except Unusable:
        # Released editions need no repository.
        if not later or not all(newest.get(each.protocol) for each in later):
            raise
        committed = []
    known = {each.protocol for each in later}
    found: list[Listed] = []
    for name, files in newest.items():
        read = partial(working_edition, files[0])
        # What only looks like an edition of a protocol is none.
        if name in known or Listed("", "", read).protocol == name:
            was = next((each for each in committed if each.protocol == name), None)
            there = "" if was is None else was.file
            found.append(Listed(files[0].as_posix(), there, read, name))
    done = {each.protocol for each in found}
    return [*found, *(each for each in committed if each.protocol not in done)]


def specs_at(revision: Revision) -> list[Listed]:
    """Return the specs that a revision has of the project."""
    folder = revision.path_of("")
    folders = [folder]
    if revision.folder == Path():
        # No spec lies here, so any folder above may have been that of the project.
        above = [*Path(folder).parents] if folder else []
        folders = [f"{folder}{FOLDER}/", *(_path(each) + f"{FOLDER}/" for each in above)]
    files = next(filter(None, (_yaml(revision.files(each)) for each in folders)), [])
    return [
        Listed(path, Path(path).name, partial(_read_at, revision, path)) for path in sorted(files)
    ]


def _yaml(files: list[str]) -> list[str]:
    return [file for file in files if file.endswith(".yaml")]


def _path(folder: Path) -> str:
    return "" if folder == Path() else f"{folder.as_posix()}/"


def _read_at(revision: Revision, path: str) -> Edition:
    return edition_of(revision.source(path))


def folder_of(spec: Path) -> Path:
    """Return the folder of a spec in full."""
    return spec.parent.resolve()
