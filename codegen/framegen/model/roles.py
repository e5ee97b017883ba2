"""The roles of the endpoints: the client, the device, and the kind of each message.

The first endpoint of a spec is the client, which the library is for; the second is the device that
it talks to. Further endpoints may receive the same frames: their directions are decoded, but no
client is made for them. The order of the messages does not matter.
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
        """The direction from the client to the device."""
        return Direction(self.client, self.device)

    @property
    def received(self) -> Direction:
        """The direction from the device to the client."""
        return Direction(self.device, self.client)

    @property
    def directions(self) -> tuple[Direction, Direction]:
        """Both directions, the client's first."""
        return self.sent, self.received


def settle(spec: Spec) -> Roles:
    """Determine the roles. Needs a spec that keeps the rule endpoints."""
    client, device, *_ = spec.endpoints
    return Roles(client, device)


def kinds(messages: Mapping[str, Message], roles: Roles) -> dict[str, Kind]:
    """Tell a `query`, which has a `reply`, from a `command` of the client's and a `report`."""
    replies = {message.reply for message in messages.values()}

    def kind(name: str, message: Message) -> Kind:
        if message.reply is not None:
            return "query"
        if name in replies:
            return "reply"
        return "command" if message.direction.sender == roles.client else "report"

    return {name: kind(name, message) for name, message in messages.items()}
