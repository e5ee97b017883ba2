"""The interface of a peer that checks what it reads."""

from __future__ import annotations

from abc import ABC
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


class Work(NamedTuple):
    """What a peer does in a row: called with what the row is given, in order."""

    do: Callable[..., Any]
    plain: Callable[[Any], object] = bytes
    """What it returns in the form of the floor: used to check, never timed."""


class Port:
    """A port in memory: it keeps what is written, and each write lets `waiting` be read again."""

    timeout = None
    is_using = False

    def __init__(self, waiting: bytes = b"") -> None:
        self.waiting = waiting
        self.written = b""
        self._at = 0

    def write(self, data: Any) -> int:
        """Take what is written."""
        self.written, self._at = bytes(data), 0
        return len(data)

    def read(self, size: int = 1) -> bytes:
        """Return what has come."""
        start = self._at
        self._at = min(start + size, len(self.waiting))
        return self.waiting[start : self._at]

    @property
    def is_empty(self) -> bool:
        """Whether all has been read."""
        return self._at == len(self.waiting)


class Peer(ABC):
    """One library, used as its own documentation advises."""

    name: str
    """How the tables call it."""

    distribution: str
    """The distribution whose version the tables show."""

    works: Mapping[str, Work]
    """What it does, by row."""

    remark: str = ""
    """What a reader of the tables should know."""

    @property
    def title(self) -> str:
        """Name and version."""
        try:
            return f"{self.name} {version(self.distribution)}"
        except PackageNotFoundError:
            return self.name
