"""The direction of a message as it is shown: who sends, who receives, and on which side one is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class Way:
    """A direction. `variant` is `to` where the user of the library sends, `from` elsewhere."""

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


def way(model: Model, direction: Direction) -> Way:
    """Return how a direction of a protocol is shown."""
    variant = "to" if direction == model.roles.sent else "from"
    return Way(direction.sender, direction.receiver, direction.key, variant)
