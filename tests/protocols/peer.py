"""A peer: what somebody else wrote for a protocol, and what it can say and tell."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, TypeAlias

import pytest

# The values of a message, by name.
Values: TypeAlias = dict[str, Any]
# What narrows the values of messages, by the name of the message.
Narrowed: TypeAlias = Mapping[str, Callable[[Values], Values]]

MISSING = "{} is not installed: it is in the dependency group `test`"


class Peer:
    """A peer: what it writes, and what it reads, by the names of messages."""

    protocol: ClassVar[str]
    package: ClassVar[str]
    # Values of a message that it writes, narrowed to what it can say.
    writes: ClassVar[Narrowed]
    # The same of those that it reads.
    reads: ClassVar[Narrowed]

    def __init__(self) -> None:
        self.module: Any = pytest.importorskip(self.package, reason=MISSING.format(self.package))

    def write(self, message: str, values: Values) -> bytes:
        """Return the frame that it writes for a message."""
        raise NotImplementedError

    def read(self, message: str, frame: bytes) -> Values:
        """Return what it reads in a frame, but for what it does not tell."""
        raise NotImplementedError


def as_is(values: Values) -> Values:
    """Return the values: it can say them all."""
    return values


def with_values(**fixed: Callable[[Any], Any]) -> Callable[[Values], Values]:
    """Return what narrows some values."""

    def narrowed(values: Values) -> Values:
        return values | {name: change(values[name]) for name, change in fixed.items()}

    return narrowed
