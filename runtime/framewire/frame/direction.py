"""The direction of a message: its sender and its receiver."""

from __future__ import annotations

from enum import Enum

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing_extensions import Self


class Direction(Enum):
    """The direction of a message. Each protocol has its own: a subclass, with members.

    A member is made of its value, and of the names of the ends that send and receive.
    """

    _value_: str
    sender: str
    """The end that sends."""
    receiver: str
    """The end that receives."""

    def __new__(cls, value: str, sender: str = "", receiver: str = "") -> Self:
        """Return a member; what it is called stands in front of it."""
        member = object.__new__(cls)
        member._value_ = value
        member.sender = sender
        member.receiver = receiver
        return member

    # Members are singletons: hashing them by identity spares each look-up a call into Python.
    __hash__ = object.__hash__
