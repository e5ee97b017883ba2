"""From a spec to every file that follows from it: pure, and the same bytes wherever it runs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from framegen.output import banner
from framegen.targets.table import TARGETS

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.compile import Compiled
    from framegen.targets.target import Snippets, Target


@dataclass(frozen=True, slots=True)
class Rendered:
    """The files, by path below the project's root, and the folders that hold nothing else."""

    files: dict[str, str]
    folders: tuple[str, ...]
    digest: str


def render(compiled: Compiled, targets: Iterable[Target] = TARGETS) -> Rendered:
    """Everything that the targets make of a spec. Raises Unusable where it has findings."""
    files: dict[str, str] = {}
    folders: list[str] = []
    for target in targets:
        rendered = target.render(compiled, snippets())
        files |= {path: _headed(target, path, text, compiled) for path, text in rendered.items()}
        folders += target.folders(compiled.model)
    return Rendered(dict(sorted(files.items())), tuple(folders), compiled.source.digest)


def _headed(target: Target, path: str, text: str, compiled: Compiled) -> str:
    """Put the banner on top of a file whose language has comments, save for one that is empty."""
    comment = target.comments.get(PurePosixPath(path).suffix)
    if comment is None or not text:
        return text
    return f"{comment.before}{banner(compiled.source.path)}{comment.after}\n{text}"


def snippets() -> Snippets:
    """How each target that is a language shows an example, by its name."""
    return {target.name: target.snippet for target in TARGETS if target.snippet is not None}
