"""Change: each end hears itself, or does not any more."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import switched

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    link = both.part_of("link")
    words = ("has no local echo any more", "has a local echo now")
    yield from switched(
        "local-echo", link, "local_echo", link.old.local_echo, link.new.local_echo, words
    )


RULE = ChangeRule(
    id="local-echo",
    title="Each end hears itself, or does not any more",
    subject="line",
    why=(
        "A client drops as many bytes as it has sent where it hears itself. Where it should and "
        "does not, it drops replies."
    ),
    do="Say what the wiring does: a single wire echoes, and a pair of wires does not.",
    at="link",
    before="local_echo: false",
    after="local_echo: true",
    look=_look,
)
