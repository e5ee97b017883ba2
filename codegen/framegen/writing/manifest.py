"""The manifest: the list of framegen's own files, kept beside the output."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from hashlib import sha256
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen import __version__
from framegen.output import banner
from framegen.vendored import not_recorded

if TYPE_CHECKING:
    from collections.abc import Mapping

_COMMENT = re.compile(r"# (?:(spec|spec-sha256|framegen|state): )?(.*)")
_UNDER_WAY = "being written, or left so by a run that was killed"
# As `sha256sum` writes and reads it.
_LINE = re.compile(r"([0-9a-f]{64})  (\S.*)")
# What no path of the output begins with, or holds: it would lead out of the root.
_ASTRAY = re.compile(r"/|[A-Za-z]:|(?:.*/)?\.\.?(?:/|$)|.*(?:\\|//|/$)")


def file_digest(data: bytes) -> str:
    """Return the SHA-256 of a file with LF line ends, so that a checkout with others is no edit."""
    return sha256(_with_lf(data)).hexdigest()


def as_data(content: str | bytes) -> bytes:
    """Return what a file holds, of text in UTF-8."""
    return content.encode() if isinstance(content, str) else content


def content_digest(content: str | bytes) -> str:
    """Return the SHA-256 of what is to be written."""
    return file_digest(as_data(content))


def holds(data: bytes, content: str | bytes) -> bool:
    """Tell whether a file holds that, whatever its line ends: whether their digests are one."""
    wanted = as_data(content)
    return data == wanted or _with_lf(data) == _with_lf(wanted)


def _with_lf(data: bytes) -> bytes:
    return data.replace(b"\r\n", b"\n") if b"\r" in data else data


@dataclass(frozen=True, slots=True)
class Manifest:
    """What framegen wrote from a spec: by path, the digests by which it knows a file as its own.

    A path has several while a run is `under_way`, and where git has merged two lists; a file that
    matches any is framegen's. `whole` is False where the text could not be read completely.
    """

    spec: str
    digest: str = ""
    files: Mapping[str, frozenset[str]] = field(default_factory=dict)
    version: str = __version__
    whole: bool = True
    under_way: bool = False

    @property
    def joined(self) -> frozenset[str]:
        """Paths whose lines git has merged from two lists, and maybe the files as well."""
        several = () if self.under_way else self.files
        return frozenset(path for path in several if len(self.files[path]) > 1)

    def text(self) -> str:
        """Return the manifest as it is written, one sorted line for each file.

        Where a folder has a record of what is in it, that has one, except while a run is under way.
        """
        facts = {
            "spec": visible(self.spec),
            "spec-sha256": self.digest,
            "framegen": self.version,
            "state": _UNDER_WAY if self.under_way else "",
        }
        head = [f"# {banner(self.spec)}", *(f"# {key}: {it}" for key, it in facts.items() if it)]
        lines = [
            f"{digest}  {path}"
            for path in sorted(self.files if self.under_way else not_recorded(self.files))
            for digest in sorted(self.files[path])
        ]
        return "".join(f"{line}\n" for line in [*head, *lines])


def read_record(data: bytes, folder: str) -> dict[str, frozenset[str]]:
    """Return what the record of a folder says: the digests of its files, by path below the root."""
    files: dict[str, frozenset[str]] = {}
    for line in data.decode("utf-8", errors="replace").splitlines():
        if listed := _listed(line):
            path = f"{folder}/{listed[1]}"
            files[path] = files.get(path, frozenset()) | {listed[0]}
    return files


def _listed(line: str) -> tuple[str, str] | None:
    """Return the digest and the path of a line; None for any other."""
    found = _LINE.fullmatch(line)
    return None if found is None or _ASTRAY.match(found[2]) else (found[1], found[2])


def read_manifest(data: bytes) -> Manifest:
    """Read a manifest; what cannot be read, such as conflict markers, is skipped."""
    text = data.decode("utf-8", errors="replace").replace("\r\n", "\n")
    facts: dict[str, str] = {}
    files: dict[str, set[str]] = {}
    whole = text.startswith(f"# {banner('')[: -len('. DO NOT EDIT.')]}") and text.endswith("\n")
    for line in text.removesuffix("\n").split("\n"):
        if (comment := _COMMENT.fullmatch(line)) is not None:
            if comment[1]:
                facts[comment[1]] = comment[2]
        elif listed := _listed(line):
            digest, path = listed
            files.setdefault(path, set()).add(digest)
        else:
            whole = False
    return Manifest(
        facts.get("spec", ""),
        facts.get("spec-sha256", ""),
        {path: frozenset(digests) for path, digests in files.items()},
        facts.get("framegen", ""),
        whole,
        facts.get("state") == _UNDER_WAY,
    )
