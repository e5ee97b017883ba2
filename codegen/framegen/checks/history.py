"""Rule: every version that a spec mentions is in its history."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    version = spec.protocol.version
    known: dict[str, int] = {}
    for index, release in enumerate(spec.history):
        first = known.setdefault(release.version, index)
        if first != index:
            yield Problem(
                ("history", index, "version"),
                f"the version {release.version} is listed twice",
                also=(("history", first, "version"), "the first is here"),
            )
    if known and version not in known:
        yield Problem(
            ("protocol", "version"),
            f"the history does not have the version {version}",
            "say in `history` what it changed",
        )
    versions = known or {version: 0}
    for name, message in spec.messages.items():
        if message.since and message.since not in versions:
            yield Problem(
                ("messages", name, "since"),
                f"there is no version {message.since} of this spec",
                did_you_mean(message.since, versions),
            )


RULE = StructureRule(
    id="history",
    title="Every version that a spec mentions is in its history",
    why="Users who upgrade read the history; a version that is missing there takes them by "
    "surprise.",
    bad='protocol: {version: "1.1.0"}  # and no 1.1.0 in `history`',
    good='history: [{version: "1.1.0", changes: [LampFade is new.]}]',
    look=_look,
)
