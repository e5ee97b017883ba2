"""Written apart: faults of one reply on its way, as scripts for the independent board.

A script takes the frame of a reply and returns what is sent in its place: pieces, each so many
seconds after the reply is due. Bytes that a wire is still carrying then go first.
"""

from collections.abc import Callable
from typing import NamedTuple

Script = Callable[[bytes], list["Piece"]]


class Piece(NamedTuple):
    """Bytes that are sent `after` so many seconds; the board records a report among them.

    Behind its first `size` bytes, if there is a `pause`, nothing is sent for so long.
    """

    after: float
    data: bytes
    is_report: bool = False
    size: int = 0
    pause: float = 0.0


def whole(reply: bytes) -> list[Piece]:
    """Send the reply as it should be."""
    return [Piece(0.0, reply)]


def duplicated(after: float = 0.0, copies: int = 1) -> Script:
    """Send the reply again, `after` seconds later, and again."""
    return lambda reply: [Piece(after * number, reply) for number in range(copies + 1)]


def late(by: float) -> Script:
    """Send the reply late. Other bytes that are due meanwhile go out meanwhile."""
    return lambda reply: [Piece(by, reply)]


def dropped(_reply: bytes) -> list[Piece]:
    """Never send the reply."""
    return []


def cut(size: int, *behind: Piece) -> Script:
    """Send only the first bytes, then `behind`: a report, say, after a silence.

    For a `size` below 0, so many bytes are missing.
    """
    return lambda reply: [Piece(0.0, reply[:size]), *behind]


def lost(start: int, count: int, *behind: Piece) -> Script:
    """Lose bytes in the middle."""
    return lambda reply: [Piece(0.0, reply[:start] + reply[start + count :]), *behind]


def miscounted(by: int) -> Script:
    """Send a wrong byte behind the command: the count of positions, or half a voltage."""

    def script(reply: bytes) -> list[Piece]:
        data = bytearray(reply)
        data[4] = (data[4] + by) % 256
        return [Piece(0.0, bytes(data))]

    return script


def mislengthened(by: int) -> Script:
    """Send a wrong length."""

    def script(reply: bytes) -> list[Piece]:
        data = bytearray(reply)
        data[2] = (data[2] + by) % 256
        return [Piece(0.0, bytes(data))]

    return script


def preceded(data: bytes, *, is_report: bool = False) -> Script:
    """Send noise, or a report, first."""
    return lambda reply: [Piece(0.0, data, is_report), Piece(0.0, reply)]


def followed(data: bytes, after: float = 0.0, *, is_report: bool = False) -> Script:
    """Send noise, or a report, behind it."""
    return lambda reply: [Piece(0.0, reply), Piece(after, data, is_report)]


def halted(size: int, pause: float) -> Script:
    """Send the reply in two pieces, with a pause between them, in which nothing else is sent."""
    return lambda reply: [Piece(0.0, reply, size=size, pause=pause)]
