"""The recordings among the files of a site, found by what they hold."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from framegen.audit.audit import audit
from framegen.audit.recording import read_recording
from framegen.audit.report import summary
from framegen.reading.yamltree import Unusable
from framegen.site.guides.linked_files import is_linked

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.model.model import Model

# Larger ones are not looked into: the reference decoder is slow.
_MAX_BYTES = 200_000
# A recording is of a protocol whose messages are at least so much of it.
_LEAST = 0.5


@dataclass(frozen=True, slots=True)
class RecordingFile:
    """A recording by its path below the root of the site, its size, and what it holds.

    `about` is the path of the text that tells more of it, if there is one.
    """

    path: str
    size: int
    summary: str
    about: str

    @property
    def name(self) -> str:
        """The name of the file."""
        return PurePosixPath(self.path).name

    @property
    def word(self) -> str:
        """The name as one word of a shell."""
        return shlex.quote(self.name)


def recordings_of(model: Model, files: Mapping[str, bytes]) -> list[RecordingFile]:
    """Return the files that are mostly messages of a protocol."""
    found: list[RecordingFile] = []
    for path, content in files.items():
        said = _summary(model, path, content) if is_linked(path) else ""
        if said:
            about = PurePosixPath(path).with_suffix(".md").as_posix()
            found.append(RecordingFile(path, len(content), said, about if about in files else ""))
    return found


def _summary(model: Model, path: str, content: bytes) -> str:
    """Say what a recording holds; nothing where it is no recording of the protocol."""
    if not 0 < len(content) <= _MAX_BYTES or path.endswith(".md"):
        return ""
    try:
        recording = read_recording(path, content, [*model.spec.endpoints], model.roles)
    except Unusable:
        return ""
    found = audit(model, [recording], model.directions)
    fits = found.size and 1 - found.noise / found.size >= _LEAST
    return summary(found) if fits and found.seen else ""
