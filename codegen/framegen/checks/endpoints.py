"""Rule: a line has two ends, and the first one named is the library's user."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.edition import FIRST_ENDPOINT_IS_CLIENT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec

_MEANING = "first the one that the library is for, then the one that it talks to"


def _look(spec: Spec) -> Iterator[Problem]:
    if len(spec.endpoints) < 2:
        what = f"a line has two ends, and {len(spec.endpoints)} is named here"
        yield Problem(("endpoints",), what, f"name both: {_MEANING}", on_key=True)
        return
    first = next(iter(spec.messages.values()), None)
    if spec.framegen >= FIRST_ENDPOINT_IS_CLIENT or first is None:
        return
    client, device = list(spec.endpoints)[:2]
    sender, receiver = first.direction.sender, first.direction.receiver
    if (sender, receiver) != (client, device) and {sender, receiver} <= spec.endpoints.keys():
        what = (
            f"edition {spec.framegen} took `{sender}`, which sends the first message, for the "
            f"library's user, and `{receiver}` for the other end; now those are the first two "
            f"endpoints, `{client}` and `{device}`"
        )
        hint = (
            f"write `framegen: {FIRST_ENDPOINT_IS_CLIENT}`, and name the endpoints in this order: "
            + _MEANING
        )
        yield Problem(("endpoints",), what, hint, on_key=True)


RULE = StructureRule(
    id="endpoints",
    title="A line has two ends, and the first one named is the library's user",
    why="The client is made for the first endpoint, and talks to the second. Edition 1 of the "
    "language took whoever sends the first message for the client: where the two differ, nobody "
    "can say which was meant.",
    bad="endpoints: {lamp: The lamp.}",
    good="endpoints: {host: Who switches the lamp., lamp: The lamp.}",
    look=_look,
)
