"""Lines to the programs of others: pseudo-terminals, with a device or another terminal behind."""

import os
import select
import threading
import tty
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Protocol


class Receiver(Protocol):
    """The device end of a library: bytes in, bytes out."""

    def receive(self, data: bytes, /) -> bytes:
        """Take in bytes, and return those to send back."""


class _Terminal:
    """A pseudo-terminal: what programs open, and the end behind it."""

    def __init__(self) -> None:
        self.behind, self._open = os.openpty()
        tty.setraw(self._open)
        self.port = os.ttyname(self._open)

    def close(self) -> None:
        os.close(self.behind)
        os.close(self._open)


@contextmanager
def served(device: Receiver, *, echo: bool = False) -> Iterator[str]:
    """Serve a device at a port, and return its name; `echo` is that of a single wire."""
    terminal = _Terminal()

    def answer(data: bytes) -> None:
        _write(terminal.behind, (data if echo else b"") + device.receive(data))

    with _pumped({terminal.behind: answer}):
        yield terminal.port
    terminal.close()


@contextmanager
def crossed() -> Iterator[tuple[str, str]]:
    """Return the names of two ports, each of which carries to the other."""
    left, right = _Terminal(), _Terminal()
    with _pumped(
        {
            left.behind: lambda data: _write(right.behind, data),
            right.behind: lambda data: _write(left.behind, data),
        }
    ):
        yield left.port, right.port
    left.close()
    right.close()


@contextmanager
def _pumped(ends: dict[int, Callable[[bytes], None]]) -> Iterator[None]:
    """Give what arrives at each end to its function, in a thread of its own."""
    stop, told = os.pipe()

    def run() -> None:
        while True:
            ready, _, _ = select.select([stop, *ends], [], [])
            if stop in ready:
                return
            for end in ready:
                ends[end](os.read(end, 4096))

    thread = threading.Thread(target=run, name="pseudo-terminal")
    thread.start()
    try:
        yield
    finally:
        os.write(told, b"!")
        thread.join()
        os.close(stop)
        os.close(told)


def _write(end: int, data: bytes) -> None:
    while data:
        data = data[os.write(end, data) :]
