"""The interface between a client and a line: anything with these methods is a transport."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import Protocol
else:
    Protocol = object  # it is for type checkers alone


class Transport(Protocol):
    """Anything that carries bytes both ways, complete and in order, or raises an error.

    Inherit from nothing: having the methods is enough. A `name` of type str, if there is one, is
    what errors and logs call the line; a method `reopen()`, if there is one, returns the same line
    opened anew; if there is a `largest_frame` of type int, longer frames are refused before they
    are sent. A method `on_readable(callback)`, if there is one, calls `callback` from then on, in
    any thread, when a read would not have to wait: for clients of asyncio without threads. Failures
    are raised as TransportError. `read` and `write` may run at the same time in two threads, but
    never two reads nor two writes.
    """

    def read(self, timeout: float) -> bytes:
        """Return the bytes that have arrived, waiting up to `timeout` seconds for the first one.

        b"" says that nothing came in that time, and never that the line has ended: that is a
        TransportError.
        """
        raise NotImplementedError

    def write(self, data: bytes) -> None:
        """Write all of `data`, or raise, within a second or two: the caller waits for it.

        It need not be on the wire yet.
        """

    def drain(self, timeout: float) -> None:
        """Return once all that was written is on the wire, or after `timeout` seconds."""

    def close(self) -> None:
        """Close the line; may be called again. A read in another thread ends soon."""
