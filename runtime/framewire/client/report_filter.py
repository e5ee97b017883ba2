"""A filter for the reports that somebody waits for: of some classes, with some field values."""

from __future__ import annotations

from ..frame.message import Message

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import TypeAlias

    from ..frame.direction import Direction

Kinds: TypeAlias = type[Message] | tuple[type[Message], ...]


class ReportFilter:
    """Reports of one class, or of any of a tuple of them, with these values in these fields.

    A field that a class lacks is not compared. Raises TypeError for a class that is not `received`
    at this end, and for a field that none of the classes has.
    """

    __slots__ = ("fields", "kinds")

    def __init__(self, received: Direction, kinds: Kinds, fields: Mapping[str, int]) -> None:
        self.kinds = kinds if isinstance(kinds, tuple) else (kinds,)
        self.fields = dict(fields)
        if not self.kinds:
            raise TypeError("no class of reports is named: give one, or a tuple of some")
        for kind in self.kinds:
            if not (isinstance(kind, type) and issubclass(kind, Message)):
                raise TypeError(f"{kind!r} is no class of messages")
            if getattr(kind, "DIRECTION", None) is not received:
                raise TypeError(f"{kind.__name__} is no message that comes to this end")
        for name in self.fields:
            if not any(name in kind.__match_args__ for kind in self.kinds):
                raise TypeError(self._without_field(name))

    def __str__(self) -> str:
        return " or ".join(
            f"{kind.__name__}({', '.join(f'{name}={value}' for name, value in requested.items())})"
            for kind, requested in ((kind, self.requested_of(kind)) for kind in self.kinds)
        )

    def requested_of(self, kind: type[Message]) -> dict[str, int]:
        """Return the values required, in those fields that messages of a class have."""
        known = kind.__match_args__
        return {name: value for name, value in self.fields.items() if name in known}

    def is_met_by(self, message: Message) -> bool:
        """Return whether this is one of the reports."""
        kind = type(message)
        return kind in self.kinds and self._agrees(message)

    def may_follow(self, command: Message, reports: tuple[type[Message], ...]) -> bool:
        """Return whether a command that causes such reports may cause one of these.

        A field that command and report share, such as a number, must have the required value.
        """
        return not set(reports).isdisjoint(self.kinds) and self._agrees(command)

    def _agrees(self, message: Message) -> bool:
        requested = self.requested_of(type(message))
        return all(getattr(message, name) == value for name, value in requested.items())

    def _without_field(self, name: str) -> str:
        known = {kind.__name__: ", ".join(kind.__match_args__) or "none" for kind in self.kinds}
        if len(known) == 1:
            ((only, fields),) = known.items()
            return f"{only} has no field {name!r}; it has {fields}"
        listed = "; ".join(f"{kind} has {fields}" for kind, fields in known.items())
        return f"none of these has a field {name!r}: {listed}"
