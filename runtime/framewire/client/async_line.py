"""A line between a transport and an event loop: what its two kinds have to offer."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, TypeVar

from ..line.link_errors import TransportError

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable

    from ..line.error_mapping import ErrorMapping
    from .library import Library
    from .request import Request

_Result = TypeVar("_Result")


class AsyncLine:
    """One connection. It stays what it is when the client goes on with another.

    What becomes of it is said in the loop: `arrived(line, data, began, ended)` of every read that
    matters, `written(question, when)` of questions, and `lost(line, error)`. Whose methods these
    are may be forgotten at any time; the line then ends by itself.
    """

    def __init__(
        self,
        library: Library,
        transport: ErrorMapping,
        clock: Callable[[], float],
        *,
        arrived: Callable[[AsyncLine, bytes, float, float], None],
        written: Callable[[Request, float], None],
        lost: Callable[[AsyncLine, TransportError], None],
    ) -> None:
        self._library = library
        self.transport = transport
        self._clock = clock
        self._arrived = weakref.WeakMethod(arrived)
        self._written = weakref.WeakMethod(written)
        self._lost = weakref.WeakMethod(lost)

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Begin to carry bytes."""
        raise NotImplementedError

    def write(self, frames: list[bytes], question: Request | None) -> None:
        """Hand frames over, the last of which is that of `question`, if there is one."""
        raise NotImplementedError

    def look_at(self, tick_at: float | None, resting_until: float, /) -> None:
        """Say `arrived` at that time at the latest; before the other one, nothing is complete."""
        raise NotImplementedError

    async def handed_over(self) -> None:
        """Wait until the transport has taken all frames so far, or the line is let go."""

    def let_go(self) -> None:
        """Have nobody wait any more until frames are handed over: the line has failed."""

    async def call(self, blocking: Callable[[], _Result]) -> _Result:
        """Call what may block for as long as the transport does."""
        return blocking()

    async def open(self, opener: Callable[[], ErrorMapping]) -> ErrorMapping:
        """Open a line anew; one that opens when nobody waits any more is closed again."""
        return await self.call(opener)

    def stop(self) -> None:
        """Write what has been handed over, and nothing more."""

    def shut(self, drain: float) -> None:
        """Write what is left, wait up to `drain` seconds for the wire, and close the transport."""
        self.stop()
        try:
            if drain:
                self.transport.drain(drain)
        except TransportError as error:
            self._library.log().debug("%s could not be drained: %s", self.transport.name, error)
        finally:
            self.transport.close()
