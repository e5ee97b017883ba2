"""Puts what was rendered on disk, all of it or none of it, and tells what would change."""

from __future__ import annotations

import re
from contextlib import ExitStack, suppress
from dataclasses import dataclass
from difflib import unified_diff
from io import StringIO
from typing import TYPE_CHECKING, Literal

from framegen.console import visible
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from framegen.render import Rendered

# What Python and the desktop leave behind in any folder, and nobody wrote.
_LITTER = frozenset(["__pycache__", ".DS_Store", "Thumbs.db"])
_STAGED, _KEPT = ".framegen-new", ".framegen-old"
# How every file of the output begins, whatever its language.
_MARK = re.compile(
    r"\W*(?:comment\W+)?(?:code )?generated[ _]by\W+framegen |<!doctype html>", re.IGNORECASE
)


@dataclass(frozen=True, slots=True)
class Change:
    """One file that differs from what was rendered. `new` is None where no file should be."""

    path: str
    why: Literal["missing", "stale", "edited by hand", "orphaned"]
    old: str | None
    new: str | None

    def diff(self) -> str:
        """The change as a unified diff."""
        before = "/dev/null" if self.old is None else f"a/{visible(self.path)}"
        after = "/dev/null" if self.new is None else f"b/{visible(self.path)}"
        old, new = (list(StringIO(text or "")) for text in (self.old, self.new))
        shown = "".join(
            line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
            for line in unified_diff(old, new, before, after)
        )
        # An empty file that comes or goes has no lines to show.
        return shown or f"--- {before}\n+++ {after}\n"


def changes(root: Path, rendered: Rendered) -> list[Change]:
    """How what is on disk differs from what was rendered."""
    found: list[Change] = []
    for path, new in rendered.files.items():
        old = _read(root / path)
        if old is None:
            found.append(Change(path, "missing", None, new))
        elif old != new:
            # A file that carries the digest of this very spec was right once.
            by_hand = rendered.digest in old
            found.append(Change(path, "edited by hand" if by_hand else "stale", old, new))
    found.extend(
        Change(path, "orphaned", _read(root / path), None) for path in _orphans(root, rendered)
    )
    return sorted(found, key=lambda change: change.path)


def write(root: Path, rendered: Rendered) -> list[Change]:
    """Makes the disk agree, and returns what was changed.

    New files are staged beside the old ones first; should anything fail, the old ones come back.
    Raises Unusable, with nothing changed.
    """
    found = changes(root, rendered)
    for change in found:
        if change.new is None and _MARK.match(change.old or "") is None:
            raise Unusable(
                f"{visible(change.path)} was not written by framegen, "
                "and stands where only its output is",
                hint="move it elsewhere; nothing was changed",
            )
    try:
        _apply(root, found)
    except OSError as error:
        reason = error.strerror or str(error)
        name = error.filename or root
        raise Unusable(
            f"{visible(str(name))} cannot be written: {reason}", hint="nothing was changed"
        ) from None
    return found


def _apply(root: Path, found: list[Change]) -> None:
    """Stages, then swaps. How each step is undone is settled before it is taken."""
    with ExitStack() as undo:
        for change in found:
            if change.new is not None:
                target = root / change.path
                _make_folder(target.parent, undo)
                staged = _beside(target, _STAGED)
                undo.callback(staged.unlink, missing_ok=True)
                staged.write_bytes(change.new.encode())
        for change in found:
            target = root / change.path
            undo.callback(_restore, target, change)
            _swap(target, change)
        undo.pop_all()
    # All is in place. An old file that resists is in nobody's way, and an orphan next time.
    with suppress(OSError), ExitStack() as tidy:
        for change in found:
            tidy.callback(_beside(root / change.path, _KEPT).unlink, missing_ok=True)


def _make_folder(folder: Path, undo: ExitStack) -> None:
    missing = [each for each in (folder, *folder.parents) if not each.exists()]
    for each in reversed(missing):
        undo.callback(_remove_empty, each)
        each.mkdir(exist_ok=True)


def _remove_empty(folder: Path) -> None:
    with suppress(OSError):
        folder.rmdir()


def _swap(target: Path, change: Change) -> None:
    """Puts the old file aside, and the staged one in its place."""
    if change.old is not None:
        target.replace(_beside(target, _KEPT))
    if change.new is not None:
        _beside(target, _STAGED).replace(target)


def _restore(target: Path, change: Change) -> None:
    """Undoes a swap, as far as it got."""
    kept = _beside(target, _KEPT)
    if kept.exists():
        kept.replace(target)
    elif change.old is None:
        target.unlink(missing_ok=True)


def _beside(target: Path, suffix: str) -> Path:
    return target.with_name(f".{target.name}{suffix}")


def _read(file: Path) -> str | None:
    """The text of a file, every byte of it telling; None where there is none."""
    try:
        return file.read_bytes().decode("utf-8", errors="surrogateescape")
    except FileNotFoundError:
        return None
    except OSError as error:
        raise Unusable(f"{visible(str(file))} cannot be read: {error.strerror or error}") from None


def _orphans(root: Path, rendered: Rendered) -> Iterator[str]:
    """Files in the folders of the output that nothing renders any more."""
    for folder in rendered.folders:
        for file in sorted((root / folder).rglob("*")):
            path = file.relative_to(root)
            known = path.as_posix() in rendered.files or not _LITTER.isdisjoint(path.parts)
            if file.is_file() and not known:
                yield path.as_posix()
