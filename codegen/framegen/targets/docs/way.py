"""The direction of a message as it is shown: who sends, who receives, and on which side one is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class Way:
    """A direction. `variant` is `to` where the user's end sends, whoever receives; else `from`."""

    sender: str
    receiver: str
    key: str
    variant: str

    @property
    def arrow(self) -> str:
        """An arrow as the user sees it: out to the device, or back from it."""
        return "→" if self.variant == "to" else "←"

    def __str__(self) -> str:
        return f"{self.sender} to {self.receiver}"


def in_prose(text: str, model: Model) -> str:
    """Write directions as prose does, `host to controller`, and not as a spec does."""
    for direction in model.directions:
        text = text.replace(str(direction), f"{direction.sender} to {direction.receiver}")
    return text


def way(model: Model, direction: Direction) -> Way:
    """Return how a direction of a protocol is shown."""
    variant = "to" if direction.sender == model.roles.sent.sender else "from"
    return Way(direction.sender, direction.receiver, direction.key, variant)
