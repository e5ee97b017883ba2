"""What a client needs of a line: anything with these methods is a transport."""

from __future__ import annotations

from typing import Protocol


class Transport(Protocol):
    """Carries bytes both ways, whole and in order, or says that it cannot.

    Inherit from nothing: having the methods is enough. A `name` of type str, if there is one, is
    what errors and logs call the line; a method `reopen()`, if there is one, returns the same line
    opened anew; of a `largest_frame` of type int, if there is one, longer frames are refused before
    they are sent. Failures are raised as TransportError. `read` and `write` may run at the same
    time in two threads, but never two reads nor two writes.
    """

    def read(self, timeout: float) -> bytes:
        """What has arrived, waiting up to `timeout` seconds for the first byte of it.

        b"" says that nothing came in that time, and never that the line has ended: that is a
        TransportError.
        """
        ...

    def write(self, data: bytes) -> None:
        """Hands over all of `data`, or raises, within a second or two: whoever writes waits for it.

        It need not be on the wire yet.
        """
        ...

    def drain(self, timeout: float) -> None:
        """Returns once what was written is on the wire, or after `timeout` seconds."""
        ...

    def close(self) -> None:
        """Gives the line back; may be called again. A read in another thread ends soon."""
        ...
