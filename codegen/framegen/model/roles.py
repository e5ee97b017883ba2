"""Who is who: which end is the library's user, which one it talks to, and what each message is.

The first endpoint of a spec is the client, which the library is for; the second is the device that
it talks to. Others can be named whom the same frames go to: they are read, and play no part. The
order of the messages says nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

from framegen.language.values import Direction

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.language.spec import Message, Spec

Kind: TypeAlias = Literal["query", "command", "reply", "report"]


@dataclass(frozen=True, slots=True)
class Roles:
    """The two ends of the line, by their names in the spec."""

    client: str
    device: str

    @property
    def sent(self) -> Direction:
        """What the client sends, and the device receives."""
        return Direction(self.client, self.device)

    @property
    def received(self) -> Direction:
        """What the device sends, and the client receives."""
        return Direction(self.device, self.client)

    @property
    def directions(self) -> tuple[Direction, Direction]:
        """Both, what the client sends first."""
        return self.sent, self.received


def settle(spec: Spec) -> Roles:
    """Settle who is who. Needs a spec that keeps the rule endpoints."""
    client, device, *_ = spec.endpoints
    return Roles(client, device)


def kinds(messages: Mapping[str, Message], roles: Roles) -> dict[str, Kind]:
    """Tell a `query`, which is due a `reply`, from a `command` of the client's and a `report`."""
    replies = {message.reply for message in messages.values()}

    def kind(name: str, message: Message) -> Kind:
        if message.reply is not None:
            return "query"
        if name in replies:
            return "reply"
        return "command" if message.direction.sender == roles.client else "report"

    return {name: kind(name, message) for name, message in messages.items()}
