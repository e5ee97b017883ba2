"""Render a spec to every file that follows from it: pure, the same bytes everywhere."""

from __future__ import annotations

from posixpath import splitext
from typing import TYPE_CHECKING

from framegen.output import Output, banner
from framegen.targets import table
from framegen.vendored import RECORD, record

if TYPE_CHECKING:
    from collections.abc import Collection

    from framegen.compile import Compiled
    from framegen.targets.target import Snippets, Target


def render(
    compiled: Compiled,
    targets: Collection[Target] | None = None,
    *,
    among: Collection[Target] | None = None,
) -> Output:
    """Render the files of one spec. Raises Unusable where it has findings.

    Only of `targets`, if they are given; the files of the others are kept apart, of those `among`
    which a project has chosen. All others are nothing to it.
    """
    every = table.TARGETS if among is None else among
    chosen = every if targets is None else targets
    files: dict[str, str] = {}
    others: dict[str, str] = {}
    folders: list[str] = []
    for target in every:
        if target.shared:
            continue
        if target in chosen:
            files |= _with_records(target, compiled)
            folders += target.folders(compiled.model)
        else:
            others |= _with_records(target, compiled)
    return Output(
        f"generated/{compiled.spec.protocol.name}.manifest",
        compiled.source.path,
        dict(sorted(files.items())),
        tuple(folders),
        compiled.source.digest,
        others,
    )


def render_shared(compiled: Compiled, targets: Collection[Target] | None = None) -> Output:
    """Render the files that are the same for every spec, and belong to framegen."""
    files: dict[str, str] = {}
    for target in table.TARGETS if targets is None else targets:
        if target.shared:
            files |= render_target(target, compiled)
    return Output("spec/framegen.manifest", "", dict(sorted(files.items())))


def render_target(target: Target, compiled: Compiled) -> dict[str, str]:
    """Render the files of one target, with a banner in each non-empty file that has comments.

    What is a copy stays as it is.
    """
    spec = "" if target.shared else compiled.source.path
    copies = tuple(f"{folder}/" for folder in target.copies(compiled.model))
    headed = target.render(compiled, snippets())
    for path, text in headed.items():
        comment = target.comments.get(splitext(path)[1])
        if comment is not None and text and not path.startswith(copies):
            headed[path] = f"{comment.before}{banner(spec)}{comment.after}\n{text}"
    return headed


def _with_records(target: Target, compiled: Compiled) -> dict[str, str]:
    """Render the files of one target, and what is recorded of those that it brings as they are."""
    files = render_target(target, compiled)
    for folder in target.copies(compiled.model):
        inside = {path: text for path, text in files.items() if path.startswith(f"{folder}/")}
        if inside:
            brought = {path.removeprefix(f"{folder}/"): text for path, text in inside.items()}
            files[f"{folder}/{RECORD}"] = record(brought)
    return files


def snippets() -> Snippets:
    """Return the function of each language target that shows an example, by the target's name."""
    return {target.name: target.snippets for target in table.TARGETS if target.snippets is not None}
