"""The direction of a message: its sender and its receiver."""

from __future__ import annotations

from enum import Enum

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from .typing_later import typing


class Direction(Enum):
    """The direction of a message. Each protocol has its own: a subclass, with members.

    A member is made of its value, and of the names of the ends that send and receive.
    """

    _value_: str
    _ends: tuple[str, str]

    def __new__(cls, value: str, sender: str = "", receiver: str = "") -> typing.Self:
        """Return a member; what it is called stands in front of it."""
        member = object.__new__(cls)
        member._value_ = value
        member._ends = sender, receiver
        return member

    # Members are singletons: hashing them by identity spares each look-up a call into Python.
    __hash__ = object.__hash__

    @property
    def sender(self) -> str:
        """The end that sends."""
        return self._ends[0]

    @property
    def receiver(self) -> str:
        """The end that receives."""
        return self._ends[1]
