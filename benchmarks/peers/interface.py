"""The interface of a peer, so that all of them do the same work."""

from __future__ import annotations

from abc import ABC, abstractmethod
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from benchmarks.floor import Parser


class Peer(ABC):
    """One library, used as its own documentation advises, behind a few methods."""

    name: str
    """How the tables call it."""

    distribution: str
    """The distribution whose version the tables show."""

    import_statement: str
    """What a fresh process runs to have the library ready."""

    import_path: str | None = None
    """A folder that this fresh process needs on its path."""

    generate_command: Sequence[str] | None = None
    """The command of its code generator, when it has one."""

    parsers: Mapping[int, Parser]
    """For every command of the controller, what makes a typed object of a frame of it."""

    lacks: Mapping[str, str]
    """What it cannot do, by the first word of the row, with the reason that the notes give."""

    def __init__(self) -> None:
        self.lacks = {}

    @abstractmethod
    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Return the MOVE frame of these (servo id, position) pairs, counts and lengths derived."""

    @abstractmethod
    def plain(self, command: int, message: Any) -> object:
        """Return a parsed frame in the form of the floor: used to check, never timed."""

    @property
    def title(self) -> str:
        """Name and version."""
        try:
            return f"{self.name} {version(self.distribution)}"
        except PackageNotFoundError:
            return self.name
