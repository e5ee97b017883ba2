"""What the templates show of closed unions: all that one end sends, and whatever is sent at all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets.python.escape import WIDTH, Bracketed
from framegen.targets.python.names import union_name
from framegen.targets.python.spelling import direction_member

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.model import Model


def unions(model: Model) -> list[UnionView]:
    """Return the unions of a protocol; an end that sends nothing has none."""
    found: dict[str, UnionView] = {}
    for direction in model.ways:
        if model.sent(direction):
            name = union_name(direction.sender)
            found.setdefault(name, UnionView(name, [], [], model)).ways.append(direction)
            found[name].senders.append(direction.sender)
    return [*found.values()]


def type_alias(name: str, types: list[str], indent: int = 0) -> str:
    """Return the assignment of a union to its name, a type a line where it is too long for one."""
    joined = " | ".join(types)
    line = f"{name}: typing.TypeAlias = {joined}"
    if indent + len(line) <= WIDTH:
        return line
    margin = "\n" + " " * indent
    if indent + 4 + len(joined) > WIDTH:
        joined = f"{margin}    | ".join(types)
    return f"{name}: typing.TypeAlias = ({margin}    {joined}{margin})"


@dataclass(frozen=True, slots=True)
class UnionView:
    """All messages that one end sends, as a type."""

    name: str
    ways: list[Direction]
    senders: list[str]
    model: Model

    @property
    def declared(self) -> str:
        """The assignment that makes it."""
        messages = self.model.messages.values()
        names = [message.name for message in messages if message.direction in self.ways]
        return type_alias(self.name, names)

    @property
    def about(self) -> list[str]:
        """Its documentation."""
        senders = " or the ".join(dict.fromkeys(self.senders))
        return [f"Whatever the {senders} sends: `isinstance` and `match` take it, too."]

    @property
    def signatures(self) -> list[str]:
        """What `decode` gives for each of its directions."""
        frame = "frame: bytes | bytearray | memoryview"
        return [
            Bracketed(
                "def decode(",
                [frame, f"direction: Literal[_library.Direction.{direction_member(way)}]"],
                f") -> {self.name}: ...",
            ).fitted(4)
            for way in self.ways
        ]
