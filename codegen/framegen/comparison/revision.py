"""A git revision: which files it has, read by the program `git`."""

from __future__ import annotations

import os
import subprocess
from dataclasses import dataclass
from shutil import which
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.language.load import refuse_size, source_of
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from pathlib import Path

    from framegen.reading.source import Source

# Git asks nobody, answers in one language, and writes nothing.
_QUIETLY = {"GIT_TERMINAL_PROMPT": "0", "GIT_OPTIONAL_LOCKS": "0", "LC_ALL": "C"}


class NoSuchRevision(Unusable):
    """No revision of the repository has that name."""


class NotInRevision(Unusable):
    """A revision has no such file."""


@dataclass(frozen=True, slots=True)
class Revision:
    """A revision of the repository that `folder` belongs to; the index has the name ""."""

    name: str
    folder: Path

    def source(self, path: str) -> Source:
        """Read a file of it, whose path is from the root, or from the folder as `./path`.

        Raises Unusable.
        """
        shown = visible(f"{self.name}:{path}")
        if not path:
            raise Unusable(f"`{shown}` names no file", hint=f"write `{shown}spec/busservo.yaml`")
        self.check()
        kind = self._git("cat-file", "-t", f"{self.name}:{path}")
        if kind is None:
            when = f"`{visible(self.name)}`" if self.name else "the index"
            raise NotInRevision(
                f"{visible(path)} is not in {when}",
                hint="name the place that it had there, such as "
                f"`{visible(self.name) or 'HEAD'}:spec/OLD.yaml`; a path is from the root of "
                "the repository, or from here as ./PATH",
            )
        if kind.strip() != b"blob":
            raise Unusable(f"{shown} is not a file", hint="name the spec itself")
        refuse_size(shown, int(self._git("cat-file", "-s", f"{self.name}:{path}") or b"0"))
        data = self._git("cat-file", "blob", f"{self.name}:{path}")
        if data is None:
            raise Unusable(
                f"{shown} cannot be read", hint="is the clone complete? `git fsck` tells"
            )
        return source_of(shown, data)

    def path_of(self, name: str) -> str:
        """Return the path from the root of a file in the folder."""
        self.check()
        prefix = self._git("rev-parse", "--show-prefix") or b""
        return os.fsdecode(prefix.rstrip(b"\r\n")) + name

    def files(self, folder: str) -> list[str]:
        """Return the paths of the files right in a folder, which is from the root and ends in `/`.

        A folder that it does not have has none.
        """
        listing = self._git("ls-tree", "-z", "--full-tree", f"{self.name}:{folder}") or b""
        rows = (row.partition(b"\t") for row in listing.split(b"\0") if row)
        return [folder + os.fsdecode(name) for kind, _, name in rows if b" blob " in kind]

    def check(self) -> None:
        """Raise Unusable, with the way out, unless git has such a revision here."""
        if self.name.startswith("-"):
            raise NoSuchRevision(
                f"`{visible(self.name)}` is no revision", hint="no name of one begins with a dash"
            )
        if self.name and self._git("rev-parse", "--quiet", "--verify", f"{self.name}^{{commit}}"):
            return
        why = self._asked("rev-parse", "--git-dir")
        if why.returncode:
            said = os.fsdecode(why.stderr).partition("\n")[0].removeprefix("fatal: ")
            raise Unusable(
                f"git finds no repository here: {visible(said)}",
                hint="name two spec files, or run this in a clone",
            )
        if self.name:
            raise self._unknown()

    def _unknown(self) -> Unusable:
        name = visible(self.name)
        if self.name == "HEAD":
            return NotInRevision("the repository has no commit yet", hint="name two spec files")
        if (self._git("rev-parse", "--is-shallow-repository") or b"").strip() == b"true":
            return NoSuchRevision(
                f"`{name}` is no revision of this clone, which is shallow",
                hint="`git fetch --unshallow --tags` brings the rest; in a workflow, check out "
                "with `fetch-depth: 0`",
            )
        return NoSuchRevision(
            f"`{name}` is no revision of the repository",
            hint="`git fetch --tags` brings what only its origin has; `git tag` lists what is here",
        )

    def _git(self, *words: str) -> bytes | None:
        """Return the output of a git command, or None if it fails."""
        done = self._asked(*words)
        return None if done.returncode else done.stdout

    def _asked(self, *words: str) -> subprocess.CompletedProcess[bytes]:
        program = which("git")
        if program is None:
            raise Unusable(
                "there is no git on this machine to look up a revision",
                hint="install git, or name two spec files",
            )
        try:
            # No shell, and no word begins with a dash that is not ours.
            return subprocess.run(  # noqa: S603
                [program, *words],
                cwd=self.folder,
                env={**os.environ, **_QUIETLY},
                stdin=subprocess.DEVNULL,
                capture_output=True,
                check=False,
            )
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or str(error)
            raise Unusable(f"git cannot be run: {visible(why)}") from None
