"""The names of a client, which follow from that of its class."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.exchanges import snake_case

if TYPE_CHECKING:
    from framegen.language.spec import Spec


@dataclass(frozen=True, slots=True)
class ClientNames:
    """The names of the client for threads, whose class is `threads`, and of that for asyncio."""

    threads: str

    @property
    def asyncio(self) -> str:
        """The class of the client for asyncio: `AsyncArm`."""
        return f"Async{self.threads}"

    @property
    def classes(self) -> frozenset[str]:
        """The classes of both."""
        return frozenset({self.threads, self.asyncio})

    @property
    def variable(self) -> str:
        """What a client is called in programs: `arm`."""
        return snake_case(self.threads)

    @property
    def opener(self) -> str:
        """The function that opens a port for threads: `open_arm`."""
        return f"open_{self.variable}"

    @property
    def async_opener(self) -> str:
        """The function that opens a port for asyncio: `open_async_arm`."""
        return f"open_async_{self.variable}"


def client_names(spec: Spec) -> ClientNames:
    """Return the names of the client of a spec."""
    return ClientNames(spec.protocol.client)
