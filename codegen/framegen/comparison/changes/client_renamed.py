"""Change: the client has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import changed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    protocol = both.part_of("protocol")
    old, new = protocol.old.client, protocol.new.client
    yield from changed("client-renamed", protocol, "client", old, new, "client")


RULE = ChangeRule(
    id="client-renamed",
    title="The client has another name",
    subject="program",
    why="Programs open a port by a function that is named after the client, and name its class.",
    do=(
        "Change the names in all programs; they can have both for a while: `from library import "
        "open_new as open_old`."
    ),
    at="protocol",
    before="client: Lantern",
    after="client: Torch",
    look=_look,
)
