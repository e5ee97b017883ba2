"""Rule: versions are semantic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.version import NoVersion, Version

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    yield from _problem(("protocol", "version"), spec.protocol.version)
    for index, release in enumerate(spec.history):
        yield from _problem(("history", index, "version"), release.version)


def _problem(path: KeyPath, version: str) -> Iterator[Problem]:
    try:
        Version.parse(version)
    except NoVersion as error:
        yield Problem(path, str(error), error.hint)


RULE = StructureRule(
    id="version",
    title="Versions are semantic",
    why="Who upgrades sees from MAJOR.MINOR.PATCH whether anything breaks: `framegen diff` says "
    "which of the three is due. Before a version come its alphas, betas and release candidates, "
    "such as 2.0.0-rc.1; other words are unknown to the packages that libraries become.",
    bad='protocol: {version: "1.0"}',
    good='protocol: {version: "1.0.0"}',
    look=_look,
)
