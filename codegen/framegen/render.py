"""From a spec to every file that follows from it: pure, and the same bytes wherever it runs."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from framegen.output import Output, banner
from framegen.targets import table
from framegen.targets.filenames import file_stem

if TYPE_CHECKING:
    from collections.abc import Collection

    from framegen.compile import Compiled
    from framegen.targets.target import Snippets, Target


def render(compiled: Compiled, targets: Collection[Target] | None = None) -> Output:
    """What is made of a spec, and of no other. Raises Unusable where it has findings.

    Of `targets` alone, if they are given; what the others make is told apart.
    """
    chosen = table.TARGETS if targets is None else targets
    files: dict[str, str] = {}
    others: dict[str, str] = {}
    folders: list[str] = []
    for target in table.TARGETS:
        if target.shared:
            continue
        if target in chosen:
            files |= render_target(target, compiled)
            folders += target.folders(compiled.model)
        else:
            others |= render_target(target, compiled)
    return Output(
        f"generated/{file_stem(compiled.spec.protocol.name)}.manifest",
        compiled.source.path,
        dict(sorted(files.items())),
        tuple(folders),
        compiled.source.digest,
        others,
    )


def render_shared(compiled: Compiled, targets: Collection[Target] | None = None) -> Output:
    """What is the same for every spec, and framegen's own."""
    files: dict[str, str] = {}
    for target in table.TARGETS if targets is None else targets:
        if target.shared:
            files |= render_target(target, compiled)
    return Output("spec/framegen.manifest", "", dict(sorted(files.items())))


def render_target(target: Target, compiled: Compiled) -> dict[str, str]:
    """The files of one target; those whose language has comments, unless empty, with a banner."""
    spec = "" if target.shared else compiled.source.path
    headed = target.render(compiled, snippets())
    for path, text in headed.items():
        comment = target.comments.get(PurePosixPath(path).suffix)
        if comment is not None and text:
            headed[path] = f"{comment.before}{banner(spec)}{comment.after}\n{text}"
    return headed


def snippets() -> Snippets:
    """How each target that is a language shows an example, by its name."""
    return {target.name: target.snippet for target in table.TARGETS if target.snippet is not None}
