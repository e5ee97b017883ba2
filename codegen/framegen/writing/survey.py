"""The survey before writing: how the disk differs, and whose each file is. Changes nothing."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, TypeAlias

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable
from framegen.vendored import recorded_folder
from framegen.writing.change import Change
from framegen.writing.kept import is_kept
from framegen.writing.manifest import (
    Manifest,
    content_digest,
    file_digest,
    holds,
    read_manifest,
    read_record,
)
from framegen.writing.marks import is_blank, is_conflicted, is_former_page, is_generated
from framegen.writing.places import Places

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from pathlib import Path

    from framegen.output import Output
    from framegen.writing.change import Why
    from framegen.writing.places import Standing

# Where the reference lay before each spec had a folder of its own.
_FORMER_REFERENCE = "docs/reference"
Lines: TypeAlias = "dict[str, frozenset[str]]"


@dataclass(slots=True)
class Survey:
    """The changes to make, in the order of the paths.

    `strangers` stand in folders of the output, in nobody's way. `left` are paths of what was
    removed, now or by a run that was killed: folders above them may be empty. `plans` are the
    manifests as they have to be while the run goes on, where that is not how they are; `finals` are
    all of them as they are at the end. `manifests` are the paths of these and of those that go.
    """

    changes: list[Change] = field(default_factory=list)
    strangers: list[str] = field(default_factory=list)
    notices: list[str] = field(default_factory=list)
    left: set[str] = field(default_factory=set)
    plans: dict[str, str] = field(default_factory=dict)
    finals: dict[str, str] = field(default_factory=dict)
    manifests: set[str] = field(default_factory=set)


def changes(root: Path, outputs: Sequence[Output]) -> list[Change]:
    """Return how the disk differs from what is wanted there."""
    return survey(root, outputs).changes


def survey(
    root: Path,
    outputs: Sequence[Output],
    *,
    all_of: str | None = None,
    shared: bool = False,
    force: bool = False,
) -> Survey:
    """Compare the disk with what is wanted. Raises Unusable where it cannot be read.

    `all_of` names a folder all of whose specs are among `outputs`: what a manifest assigns to
    another spec of that folder is removed. In a `shared` root other projects have output as well,
    and all other manifests are theirs. `force` takes over what another spec has made.
    """
    return _Surveyor(Places(root), outputs, all_of, shared=shared).look(force=force)


class _Surveyor:
    """One pass over the disk: reads the manifests, then each file that they or the outputs name."""

    def __init__(
        self, places: Places, outputs: Sequence[Output], all_of: str | None, *, shared: bool
    ) -> None:
        self._places = places
        self._outputs = outputs
        self._all_of = all_of
        self._found = Survey()
        self._wanted = _owners(outputs)
        self._manifests = {output.manifest: self._read(output.manifest) for output in outputs}
        self._shared = shared
        self._specs = {visible(output.spec) for output in outputs}
        self._known: Lines = {}
        self._folded: dict[str, str] = {}
        self._joined: frozenset[str] = frozenset()

    def look(self, *, force: bool) -> Survey:
        for output in self._outputs:
            self._expect_own(output, force=force)
        former = dict(self._former())
        manifests = [*filter(None, self._manifests.values()), *former.values()]
        self._known = _united([*(manifest.files for manifest in manifests), *self._lost()])
        self._joined = frozenset[str]().union(*(manifest.joined for manifest in manifests))
        self._folded = _folded(path for path in self._known if path not in self._wanted)
        for output in self._outputs:
            self._look_at(output)
        for path, manifest in former.items():
            for listed in manifest.files:
                self._look_at_orphan(listed)
            self._found.manifests.add(path)
            # What is recorded elsewhere is known until the end, too, however much is gone by then.
            if any(map(recorded_folder, manifest.files)):
                self._found.plans[path] = replace(manifest, under_way=True).text()
            text = self._text(self._places.look(path))
            self._found.changes.append(Change(path, "orphaned", text, None))
            self._found.left.add(path)
        self._found.changes.sort(key=lambda change: change.path)
        self._found.strangers.sort()
        return self._found

    def _read(self, path: str) -> Manifest | None:
        standing = self._places.look(path)
        if standing is None or standing.kind:
            return None
        manifest = read_manifest(standing.data)
        recorded = [self._recorded(record, manifest) for record in manifest.files]
        return replace(manifest, files=_united([manifest.files, *recorded]))

    def _recorded(self, path: str, manifest: Manifest) -> Lines:
        """Return what a listed file records of others in its folder, if it is framegen's own."""
        folder = recorded_folder(path)
        standing = self._places.look(path) if folder else None
        if standing is None or standing.kind:
            return {}
        own = file_digest(standing.data) in manifest.files.get(path, ())
        merged = path in manifest.joined or not manifest.whole
        # Where git has merged, the file may hold the lines of both.
        if own or is_conflicted(standing.data) or (merged and is_generated(standing.data)):
            return read_record(standing.data, folder)
        return {}

    def _expect_own(self, output: Output, *, force: bool) -> None:
        """Refuse to take over what another spec, which still exists, has made."""
        found = self._manifests[output.manifest]
        # Two specs of one run may have exchanged their names.
        if found is None or force or found.spec in {"", *self._specs}:
            return
        if (self._places.root / found.spec).is_file():
            raise Unusable(
                f"{output.manifest} belongs to {found.spec}, and {visible(output.spec)} "
                "has the same `name`",
                hint="give the protocol another name, or its output another place: --out FOLDER",
            )

    def _former(self) -> Iterable[tuple[str, Manifest]]:
        """Yield the manifests of a spec under its former name, and of specs that are gone."""
        if self._shared:
            return
        own = {path.casefold() for path in self._manifests}
        specs = {visible(output.spec) for output in self._outputs if not output.others}
        for folder in sorted({str(PurePosixPath(path).parent) for path in self._manifests}):
            for path in self._places.listed(folder, "*.manifest"):
                manifest = None if path.casefold() in own else self._read(path)
                if manifest is None or not manifest.spec:
                    continue
                gone = str(PurePosixPath(manifest.spec).parent) == self._all_of
                if gone or manifest.spec in specs:
                    yield path, manifest

    def _lost(self) -> Iterable[Lines]:
        """Yield what is recorded of files that a lost or damaged manifest does not know."""
        for output in self._outputs:
            manifest = self._manifests[output.manifest]
            if manifest is None or not manifest.whole:
                for path in (it for at in output.folders for it in self._places.files_below(at)):
                    yield self._recorded(path, Manifest(output.spec, whole=False))

    def _look_at(self, output: Output) -> None:
        manifest = self._manifests[output.manifest]
        listed = {} if manifest is None else manifest.files
        rebuilt = manifest is None or not manifest.whole
        there = [
            self._look_at_file(path, text, rebuilt=rebuilt)
            for path, text in output.contents.items()
        ]
        files = {path: frozenset([content_digest(text)]) for path, text in output.contents.items()}
        files |= self._others(output, rebuilt=rebuilt)
        for path, digests in listed.items():
            if output.others and not _below(path, output.folders):
                files.setdefault(path, digests)
            else:
                self._look_at_orphan(path)
        adopted = self._look_around(output, rebuilt=rebuilt)
        self._look_at_manifest(output, files, adopted)
        if rebuilt and (manifest is not None or adopted or any(there)):
            state = "is not there" if manifest is None else "is damaged"
            self._found.notices.append(
                f"{output.manifest} {state}: files are recognised by their contents"
            )

    def _look_at_file(self, path: str, text: str | bytes, *, rebuilt: bool) -> bool:
        """Compare one wanted file; tell whether it is there and framegen's own."""
        standing = self._places.look(path)
        if standing is None:
            self._found.changes.append(Change(path, "missing", None, text))
            return False
        same = standing.kind in ("", "a link") and holds(standing.data, text)
        # Where capitals tell no names apart, the orphan of this name is this very file.
        if same and path.casefold() not in self._folded:
            return True
        why = self._why(path, standing, same=same, rebuilt=rebuilt)
        if why in ("stale", "conflicted"):
            self._own(path, standing)
        self._found.changes.append(Change(path, why, self._text(standing), text))
        return why != "foreign"

    def _own(self, path: str, standing: Standing) -> None:
        """Add the digest of a file's present content to those that are framegen's."""
        digests = frozenset([file_digest(standing.data)])
        self._known[path] = self._known.get(path, frozenset()) | digests

    def _why(self, path: str, standing: Standing, *, same: bool, rebuilt: bool) -> Why:
        other_case = self._folded.get(path.casefold(), path)
        known = self._known.get(path, frozenset()) | self._known.get(other_case, frozenset())
        if standing.kind:
            return "foreign"
        if same or file_digest(standing.data) in known:
            return "stale"
        if known and is_blank(standing.data):
            return "stale"
        generated = is_generated(standing.data)
        if (known or generated) and is_conflicted(standing.data):
            return "conflicted"
        if generated and (rebuilt or path in self._joined):
            return "stale"
        return "edited by hand" if known else "foreign"

    def _look_at_orphan(self, path: str) -> None:
        """Plan the removal of a listed file that is no longer wanted, if it is a file."""
        if path in self._wanted or path in self._found.left:
            return
        self._found.left.add(path)
        standing = self._places.look(path)
        if standing is None or standing.kind:
            return
        joined = path in self._joined and is_generated(standing.data)
        if joined or is_conflicted(standing.data) or is_blank(standing.data):
            self._own(path, standing)
        own = file_digest(standing.data) in self._known[path]
        why: Why = "orphaned" if own else "edited by hand"
        self._found.changes.append(Change(path, why, self._text(standing), None))

    def _others(self, output: Output, *, rebuilt: bool) -> Lines:
        """Return the lines of what this run leaves alone, as far as they are known."""
        kept = {}
        for path, text in output.others.items():
            if digests := self._known.get(path):
                kept[path] = digests
            elif rebuilt and (standing := self._places.look(path)) and not standing.kind:
                digest = file_digest(standing.data)
                if digest == content_digest(text) or is_generated(standing.data):
                    kept[path] = frozenset([digest])
        return kept

    def _look_around(self, output: Output, *, rebuilt: bool) -> list[str]:
        """Find unlisted files in the output's folders: a stranger's, or of a lost manifest."""
        adopted = []
        for folder in output.folders:
            for path in self._places.files_below(folder):
                if path in self._wanted or is_kept(path):
                    continue
                if rebuilt and self._adopt(path, is_generated):
                    adopted.append(path)
                elif path not in self._known:
                    self._found.strangers.append(path)
        if rebuilt and output.folders and not output.others:
            for path in self._places.files_below(_FORMER_REFERENCE):
                if path in self._wanted or path in self._known:
                    continue
                if self._adopt(path, lambda data: is_former_page(data, output.spec)):
                    adopted.append(path)
        return adopted

    def _adopt(self, path: str, is_own: Callable[[bytes], bool]) -> bool:
        """Treat an unlisted file as an orphan if its text, or a record, shows that it is own."""
        if path in self._known:
            was_left = path in self._found.left
            self._look_at_orphan(path)
            return not was_left
        standing = self._places.look(path)
        if standing is None or standing.kind or not is_own(standing.data):
            return False
        self._own(path, standing)
        self._found.left.add(path)
        self._found.changes.append(Change(path, "orphaned", self._text(standing), None))
        return True

    def _look_at_manifest(self, output: Output, files: Lines, adopted: list[str]) -> None:
        manifest = self._manifests[output.manifest]
        listed = {} if manifest is None else manifest.files
        # What a part of the output was made from says nothing of the rest.
        digest = manifest.digest if manifest is not None and output.others else output.digest
        plan = {
            path: files.get(path, frozenset()) | self._known.get(path, frozenset())
            for path in {*files, *listed, *adopted}
        }
        path = output.manifest
        if not files and manifest is not None:
            # Nothing is wanted of it any more.
            self._found.manifests.add(path)
            text = self._text(self._places.look(path))
            self._found.changes.append(Change(path, "orphaned", text, None))
            self._found.left.add(path)
            return
        text = Manifest(output.spec, digest, files).text()
        self._found.manifests.add(path)
        self._found.finals[path] = text
        if manifest is None or not manifest.whole or plan != listed:
            self._found.plans[path] = Manifest(output.spec, digest, plan, under_way=True).text()
        standing = self._places.look(path)
        if standing is None:
            self._found.changes.append(Change(path, "missing", None, text))
        elif standing.kind:
            self._found.changes.append(Change(path, "foreign", None, text))
        elif not holds(standing.data, text):
            self._found.changes.append(Change(path, "stale", self._text(standing), text))

    @staticmethod
    def _text(standing: Standing | None) -> str | None:
        """Return the text of a file, each byte a character; None where there is none."""
        if standing is None or standing.kind:
            return None
        return standing.data.decode("utf-8", errors="surrogateescape")


def _owners(outputs: Sequence[Output]) -> dict[str, Output]:
    """Return the owner of each path. Raises Unusable where two want the same path in any case."""
    owners: dict[str, Output] = {}
    folded: dict[str, Output] = {}
    for output in outputs:
        for path in (output.manifest, *output.contents, *output.others):
            other = folded.setdefault(path.casefold(), output)
            if other is not output:
                raise Unusable(
                    f"{visible(other.spec)} and {visible(output.spec)} both make {visible(path)}",
                    hint="give each protocol a `name` of its own; nothing was changed",
                )
            owners[path] = output
    return owners


def _united(lists: Iterable[Mapping[str, frozenset[str]]]) -> Lines:
    known: Lines = {}
    for files in lists:
        for path, digests in files.items():
            known[path] = known.get(path, frozenset()) | digests
    return known


def _folded(paths: Iterable[str]) -> dict[str, str]:
    return {path.casefold(): path for path in paths}


def _below(path: str, folders: Iterable[str]) -> bool:
    return any(path.startswith(f"{folder}/") for folder in folders)
