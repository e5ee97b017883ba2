"""Change: a message has another name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.changes.telling import renamed

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.changes.both import Both
    from framegen.comparison.changes.change import Change


def _look(both: Both) -> Iterator[Change]:
    yield from renamed("message-renamed", both.messages)


RULE = ChangeRule(
    id="message-renamed",
    title="A message has another name",
    subject="message",
    why="Programs build and receive it by the name of its class. On the wire, nothing changes.",
    do=(
        "Change it together with another break of programs. `was` says that it is the same, as "
        "long as anybody compares with the old name."
    ),
    at="messages",
    before="LampBlink: {id: 9, fields: {lamp_id: {type: u8}}}",
    after="LampFlash: {was: LampBlink, id: 9, fields: {lamp_id: {type: u8}}}",
    look=_look,
)
