"""The board behind a pseudo terminal, which looks like a serial port. Linux and macOS."""

from __future__ import annotations

import contextlib
import os
import select
import sys
from pathlib import Path

from .backlog import Backlog
from .waker import Waker

if sys.platform != "win32":
    from .pty_rate import read_rate, set_rate

CHUNK = 4096


class PtyEnd:
    """A pty; `link` is a name for it that stays the same when it is plugged in again.

    It is at `baud` until a host sets another rate.
    """

    def __init__(self, link: str | os.PathLike[str] | None = None, baud: float = 9600) -> None:
        if sys.platform == "win32":
            raise OSError("Windows has no pseudo terminals: use TCP")
        self._link = None if link is None else Path(link)
        self._waker = Waker()
        self._backlog = Backlog()
        # The other end stays open here too, or else the pty would end whenever a host closes it.
        self._board_end = self._host_end = -1
        self._name = ""
        self._baud = max(1, round(baud))
        self._baud_before: int | None = None

    @property
    def port(self) -> str:
        """The link, or else the name of the pty."""
        return str(self._link or self._name)

    @property
    def host_baud(self) -> int | None:
        """The rate that a host has set; None if none has changed it."""
        if self._host_end < 0:
            return None
        rate = read_rate(self._host_end)
        return None if rate == self._baud_before else rate

    def plug_in(self) -> None:
        """Make the pty and the link. Raises FileExistsError if another file has that name."""
        import tty  # noqa: PLC0415 - there is none on Windows

        self._waker.open()
        self._board_end, self._host_end = os.openpty()
        tty.setraw(self._host_end)
        set_rate(self._host_end, self._baud)
        # If the system knows no such rate, one that a host sets can still be distinguished from it.
        self._baud_before = read_rate(self._host_end)
        os.set_blocking(self._board_end, False)
        self._name = os.ttyname(self._host_end)
        if self._link is not None:
            try:
                self._make_link(self._link)
            except OSError:
                self.unplug()
                raise

    def unplug(self) -> None:
        """Close both ends: readers get an error."""
        if self._board_end < 0:
            return
        if self._link is not None and self._link_leads_to(self._link) == self._name:
            self._link.unlink()
        for end in (self._board_end, self._host_end):
            os.close(end)
        self._board_end = self._host_end = -1
        self._backlog = Backlog()
        self._waker.wake()

    def deliver(self, data: bytes) -> None:
        """Write as much as the pty takes."""
        if self._board_end >= 0:
            self._backlog.send(data, lambda rest: os.write(self._board_end, rest))

    def wait(self, seconds: float | None, *, listening: bool) -> None:
        """Wait for bytes of the host, for room for those to it, or to be woken."""
        end = self._board_end
        reading: list[int] = [self._waker.fileno()]
        if end >= 0 and listening:
            reading.append(end)
        writing = [end] if end >= 0 and self._backlog.data else []
        with contextlib.suppress(OSError, ValueError):  # unplugged in the meantime
            select.select(reading, writing, [], seconds)
        self._waker.clear()

    def receive(self) -> bytes:
        """Read the bytes that are there."""
        if self._board_end < 0:
            return b""
        self.deliver(b"")
        try:
            return os.read(self._board_end, CHUNK)
        except OSError:
            return b""

    def wake(self) -> None:
        """End a wait."""
        self._waker.wake()

    def close(self) -> None:
        """Unplug it."""
        self.unplug()
        self._waker.close()

    def _make_link(self, link: Path) -> None:
        # A link to a device was left behind, as by a program that was killed.
        if self._link_leads_to(link).startswith("/dev/"):
            link.unlink()
        link.symlink_to(self._name)

    @staticmethod
    def _link_leads_to(link: Path) -> str:
        return os.readlink(link) if link.is_symlink() else ""  # noqa: PTH115 - text, not a path
