"""The editions of a project: files, what was released, and what git has of them."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeGuard

from framegen.comparison.edition import Edition
from framegen.comparison.revision import NotInRevision, Revision
from framegen.compile import compile_leniently
from framegen.console import visible
from framegen.language.load import MAX_BYTES, read_source, refuse_size, source_of
from framegen.language.version import Version
from framegen.project import all_specs, named_spec
from framegen.reading.findings import did_you_mean
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from framegen.reading.source import Source

# Below the folder of the spec.
RELEASED = "released"
_A_FILE = (".yaml", ".yml")


@dataclass
class Editions:
    """Pairs of editions, the older first, and what could not be paired."""

    pairs: list[tuple[Edition, Edition]] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class _Given:
    """An edition that was named in full: where it is, its text, and the file that it is in."""

    place: str
    source: Source
    file: Path | None = None


def find_editions(old: str | None = None, new: str | None = None) -> Editions:
    """Find and read the editions that two words name. Raises Unusable.

    Without `old`, it is the newest one released, or else the last commit; without `new`, the spec
    as it lies here. A spec of the project that is named alone is the new one. Words that name no
    protocol stand for every spec of the project.
    """
    if old is not None and old == new:
        raise Unusable(
            f"a comparison of nothing: `{visible(old)}` is named twice",
            hint="only one of the two can come from the input" if old == "-" else _NAME_TWO,
        )
    before, after = _given(old), _given(new)
    if not isinstance(before, _Given):
        if not isinstance(after, _Given):
            return _of_all(before, after)
        edition = edition_of(after.source)
        return Editions([(_beside(before, edition, after.file), edition)])
    edition = edition_of(before.source)
    if not isinstance(after, _Given):
        if after is None and _lies_here(before.file):
            return Editions([(older_edition(before.file, edition.spec.protocol.name), edition)])
        return Editions([(edition, _beside(after, edition, before.file))])
    if before.place == after.place:
        raise Unusable(f"a comparison of nothing: both are {after.source.name}", hint=_NAME_TWO)
    return Editions([(edition, edition_of(after.source))])


_NAME_TWO = "name two editions, such as `framegen diff v1.0.0` or `framegen diff old.yaml new.yaml`"


def edition_of(source: Source) -> Edition:
    """Read an edition, whatever today's rules say of it. Raises Unusable where it has no model."""
    try:
        compiled = compile_leniently(source)
    except Unusable as error:
        place = "" if error.finding is None else f"\n{error.finding.render(source)}"
        raise Unusable(f"{source.name}: {error}{place}", hint=error.hint) from None
    model = compiled.model
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


def older_edition(spec: Path, name: str) -> Edition:
    """Return what a spec is compared with unless something is named. Raises Unusable."""
    for file in released(spec.parent, name):
        return edition_of(read_source(file))
    try:
        return edition_of(_at(Revision("HEAD", _folder(spec)), spec))
    except NotInRevision:
        raise NotInRevision(
            f"{visible(spec.as_posix())} has no earlier edition yet: none is released, and no "
            "commit before this has it",
            hint="commit it, or name what to compare it with",
        ) from None


def _given(word: str | None) -> _Given | Revision | None:
    """Return what a word names: an edition, or a revision, which has one of each protocol."""
    if word is None:
        return None
    if word == "-":
        return _Given(word, _standard_input())
    if not word.strip() or "\0" in word:
        raise Unusable(f"`{visible(word)}` names no edition", hint=_NAME_TWO)
    file = _file(word)
    if file is not None:
        return _Given(str(file.resolve()), read_source(file), file)
    revision, colon, path = word.partition(":")
    if colon:
        try:
            found = Revision(revision, Path()).source(path)
        except Unusable as error:
            raise _or_a_file(word, error) from None
        return _Given(found.name, found)
    found_revision = Revision(word, _project_folder())
    try:
        found_revision.check()
    except Unusable as error:
        raise _or_a_file(word, error) from None
    return found_revision


def _file(word: str) -> Path | None:
    """Return the file that a word names: by its path, as a spec, or as a released edition."""
    file = Path(word)
    try:
        if file.exists() and not file.is_dir():
            return file
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise Unusable(f"`{visible(word)}` cannot be read: {why}", hint=_NAME_TWO) from None
    return named_spec(word) or next((each for each in _all_released() if each.stem == word), None)


def _or_a_file(word: str, error: Unusable) -> Unusable:
    """Return what is wrong with a word that is no file, and may have been meant for one."""
    if ":" in word:
        return error
    shown, names = visible(word), [file.stem for file in _all_released()]
    hint = _NAME_TWO if word.endswith(_A_FILE) else error.hint
    near = did_you_mean(word, names, otherwise=hint) if names else hint
    if Path(word).is_dir():
        return Unusable(f"{shown} is a folder, and not a spec", hint=_NAME_TWO)
    if word.endswith(_A_FILE):
        return Unusable(f"{shown} does not exist", hint=near)
    return Unusable(f"`{shown}` is no file and no released edition, and {error}", hint=near)


def _all_released() -> list[Path]:
    try:
        folder = all_specs()[0].parent / RELEASED
    except Unusable:
        return []
    return sorted(folder.glob("*.yaml"))


def _standard_input() -> Source:
    name = "standard input"
    try:
        data = sys.stdin.buffer.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise Unusable(f"{name} cannot be read: {visible(why)}") from None
    refuse_size(name, len(data))
    return source_of(name, data)


def _beside(word: Revision | None, edition: Edition, file: Path | None) -> Edition:
    """Return what an edition is compared with: the spec here, or what a revision has of it."""
    if word is not None and file is not None and file.parent.name != RELEASED:
        return edition_of(_at(word, file))
    spec = _spec_of(edition)
    return working_edition(spec) if word is None else edition_of(_at(word, spec))


def _lies_here(file: Path | None) -> TypeGuard[Path]:
    """Tell whether a file is a spec of the project as it lies here."""
    try:
        return file is not None and file.resolve() in {spec.resolve() for spec in all_specs()}
    except Unusable:
        return False


def _spec_of(edition: Edition) -> Path:
    """Return the spec of the project that is for the same protocol, or its only one."""
    name = edition.spec.protocol.name
    specs = all_specs()
    found = named_spec(name)
    if found is None and len(specs) > 1:
        found = next((spec for spec in specs if _protocol(spec) == name), None)
    if found is not None or len(specs) == 1:
        return found or specs[0]
    names = ", ".join(visible(spec.name) for spec in specs)
    raise Unusable(
        f"none of the specs is one of `{visible(name)}`: {names}",
        hint=f"name what to compare it with, such as `{visible(specs[0].stem)}`",
    )


def _protocol(spec: Path) -> str | None:
    try:
        return working_edition(spec).spec.protocol.name
    except Unusable:
        return None


def _of_all(old: Revision | None, new: Revision | None) -> Editions:
    """Pair two editions of every spec of the project; what has no earlier one is left out.

    Where nothing was named, the first edition of a spec is no error.
    """
    found, errors = Editions(), list[Unusable]()
    for spec in all_specs():
        try:
            after = working_edition(spec) if new is None else edition_of(_at(new, spec))
            name = after.spec.protocol.name
            before = older_edition(spec, name) if old is None else edition_of(_at(old, spec))
        except NotInRevision as error:
            errors.append(error)
            found.left_out.append(str(error))
        else:
            found.pairs.append((before, after))
    if not found.pairs and (old, new) != (None, None):
        raise errors[0]
    return found


def _at(revision: Revision, spec: Path) -> Source:
    """Return the text that a spec of the project has at a revision."""
    there = Revision(revision.name, _folder(spec))
    return there.source(there.path_of(spec.name))


def _folder(spec: Path) -> Path:
    return spec.parent.resolve()


def _project_folder() -> Path:
    try:
        return _folder(all_specs()[0])
    except Unusable:
        return Path()
