"""The editions of a project: files, what was released, and what git has of them."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeGuard

from framewire.command.console import visible

from framegen.comparison.listing import (
    RELEASED,
    earlier_specs,
    edition_of,
    folder_of,
    kept_before,
    released,
    specs_at,
    specs_beside,
    specs_here,
    working_edition,
)
from framegen.comparison.partners import partners
from framegen.comparison.revision import NotInRevision, Revision
from framegen.language.load import MAX_BYTES, read_source, refuse_size, source_of
from framegen.project import FOLDER, all_specs, named_spec
from framegen.reading.findings import did_you_mean
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from framegen.comparison.edition import Edition
    from framegen.comparison.partners import Listed
    from framegen.reading.source import Source

_A_FILE = (".yaml", ".yml")


@dataclass(frozen=True)
class Gone:
    """A spec that was there, or was released, and is not any more; `path` is where it was."""

    path: str
    edition: str
    protocol: str
    version: str = ""
    released: bool = False

    def __str__(self) -> str:
        return f"{self.path} is gone: everything of {self.protocol} breaks"


@dataclass
class Editions:
    """Pairs of editions, the older first; specs without an older one, and those without a newer.

    `folder` is that of the specs whose kept editions count, unless one edition was named to be
    compared with.
    """

    pairs: list[tuple[Edition, Edition]] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    gone: list[Gone] = field(default_factory=list)
    folder: Path | None = field(default=None, compare=False)

    def kept(self, old: Edition) -> list[Listed]:
        """Return the editions that are kept from before an older one of these pairs."""
        return [] if self.folder is None else kept_before(self.folder, old)


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
    protocol stand for every spec of the project. What lies here is held against kept editions
    too, unless `old` names one edition.
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
        folder = after.file.parent if _lies_here(after.file) else None
        return Editions([(_beside(before, edition, after.file), edition)], folder=folder)
    edition = edition_of(before.source)
    if not isinstance(after, _Given):
        if after is None and _lies_here(before.file):
            older = older_edition(before.file, edition.spec.protocol.name)
            return Editions([(older, edition)], folder=before.file.parent)
        return Editions([(edition, _beside(after, edition, before.file))])
    if before.place == after.place:
        raise Unusable(f"a comparison of nothing: both are {after.source.name}", hint=_NAME_TWO)
    return Editions([(edition, edition_of(after.source))])


_NAME_TWO = "name two editions, such as `framegen diff v1.0.0` or `framegen diff old.yaml new.yaml`"


def older_edition(spec: Path, name: str) -> Edition:
    """Return what a spec is compared with unless something is named. Raises Unusable."""
    for file in released(spec.parent, name):
        return edition_of(read_source(file))
    later = specs_beside(spec)
    found = partners(earlier_specs(later, spec), later)
    each = next(each for each in later if each.file == spec.name)
    if each not in found:
        raise _first(each)
    return found[each].edition


def _first(spec: Listed) -> NotInRevision:
    return NotInRevision(
        f"{visible(spec.path)} has no earlier edition yet: none is released, and no "
        "commit before this has it",
        hint="commit it, or name what to compare it with",
    )


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
        return _at(word, file)
    spec = _spec_of(edition)
    return working_edition(spec) if word is None else _at(word, spec)


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
    later = specs_here() if new is None else specs_at(new)
    try:
        earlier = earlier_specs(later, _any_spec()) if old is None else specs_at(old)
    except Unusable:
        # Where there is no project, git is not what is missing.
        _ = later or all_specs()
        raise
    if not later and not earlier:
        all_specs()
        raise NotInRevision("neither of the two has a spec", hint=_NAME_TWO)
    known, errors = partners(earlier, later), list[Unusable]()
    spec = _any_spec() if new is None else None
    found = Editions(folder=None if spec is None else spec.parent)
    for each in later:
        if each in known:
            found.pairs.append((known[each].edition, each.edition))
        else:
            # Whether it is a spec at all is worth knowing even so.
            _ = each.edition
            errors.append(_first(each) if old is None else _missing(old, each))
    found.left_out = [str(error) for error in errors]
    found.gone = [_gone(each) for each in earlier if each not in known.values()]
    if not found.pairs and not found.gone and (old, new) != (None, None):
        raise errors[0]
    return found


def _gone(spec: Listed) -> Gone:
    protocol = spec.protocol or Path(spec.file).stem
    from_released = Path(spec.path).parent.name == RELEASED
    path = f"{FOLDER}/{spec.file or f'{protocol}.yaml'}" if from_released else spec.path
    try:
        label, version = spec.edition.label, visible(spec.edition.version)
    except Unusable:
        # What cannot be read by now had users all the same.
        label, version = visible(spec.path), ""
    return Gone(visible(path), label, visible(protocol), version, from_released)


def _at(revision: Revision, spec: Path) -> Edition:
    """Return the edition that a revision has of a spec, under whatever path. Raises Unusable."""
    there, later = Revision(revision.name, folder_of(spec)), specs_beside(spec)
    (each,) = (each for each in later if each.file == spec.name)
    found = partners(specs_at(there), later)
    if each in found:
        return found[each].edition
    raise _missing(there, each)


def _missing(revision: Revision, spec: Listed) -> Unusable:
    """Return what is wrong where a revision has no edition of a spec."""
    path = revision.path_of(spec.file)
    try:
        revision.source(path)
    except Unusable as error:
        return error
    protocol, name = visible(spec.protocol), visible(revision.name)
    return NotInRevision(
        f"{visible(path)} is of another protocol in `{name}`, which has none of `{protocol}`",
        hint="name two editions of one protocol",
    )


def _project_folder() -> Path:
    spec = _any_spec()
    return Path() if spec is None else folder_of(spec)


def _any_spec() -> Path | None:
    try:
        return all_specs()[0]
    except Unusable:
        return None
