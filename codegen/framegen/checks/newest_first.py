"""Rule: the newest version is the first in the history, and that of the spec."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.version import Version

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    # What is no version is for another rule to tell.
    versions = [
        (version, ("history", index, "version"))
        for index, release in enumerate(spec.history)
        if (version := Version.parse_or_none(release.version)) is not None
    ]
    for (above, _), (below, path) in pairwise(versions):
        if above < below:
            what = f"{below} is newer than {above}, and stands below it"
            yield Problem(path, what, "list the newest version first")
    yield from _own(spec, versions)


def _own(spec: Spec, versions: Sequence[tuple[Version, KeyPath]]) -> Iterator[Problem]:
    own = Version.parse_or_none(spec.protocol.version)
    if own is None or own not in {version for version, _ in versions}:
        return
    newest, path = max(versions)
    if own < newest:
        yield Problem(
            ("protocol", "version"),
            f"the version is {own}, and the history has {newest}, which is newer",
            f'write "{newest}"',
            also=(path, "it is here"),
        )


RULE = StructureRule(
    id="newest-first",
    title="The newest version is the first in the history, and that of the spec",
    why="Who upgrades reads the history from the top down to the version that they have.",
    bad='history: [{version: "1.0.0", ...}, {version: "1.1.0", ...}]',
    good='history: [{version: "1.1.0", ...}, {version: "1.0.0", ...}]',
    look=_look,
)
