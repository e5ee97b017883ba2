"""What can become of one reply on its way: scripts that a test hands to the independent board.

A script takes the frame of a reply and gives what is sent in its place: pieces, each so many
seconds after the reply is due. What a wire is still carrying then goes first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable

    Script = Callable[[bytes], list["Piece"]]


class Piece(NamedTuple):
    """Bytes that are sent `after` so many seconds; a report is noted by the board as sent.

    Behind its first `size` bytes, if there is a `pause`, nothing is sent for so long.
    """

    after: float
    data: bytes
    is_report: bool = False
    size: int = 0
    pause: float = 0.0


def whole(reply: bytes) -> list[Piece]:
    """As it should be."""
    return [Piece(0.0, reply)]


def duplicated(after: float = 0.0, copies: int = 1) -> Script:
    """The reply comes again, `after` seconds later, and again."""
    return lambda reply: [Piece(after * number, reply) for number in range(copies + 1)]


def late(by: float) -> Script:
    """The reply comes late. What is due meanwhile goes out meanwhile."""
    return lambda reply: [Piece(by, reply)]


def dropped(_reply: bytes) -> list[Piece]:
    """The reply never comes."""
    return []


def cut(size: int, *behind: Piece) -> Script:
    """Only the first bytes come, then what is `behind`: a report, say, after a silence.

    Of a `size` below 0, so many bytes are missing.
    """
    return lambda reply: [Piece(0.0, reply[:size]), *behind]


def lost(start: int, count: int, *behind: Piece) -> Script:
    """Bytes are lost in the middle."""
    return lambda reply: [Piece(0.0, reply[:start] + reply[start + count :]), *behind]


def miscounted(by: int) -> Script:
    """The byte behind the command is wrong: the count of positions, or half a voltage."""

    def script(reply: bytes) -> list[Piece]:
        data = bytearray(reply)
        data[4] = (data[4] + by) % 256
        return [Piece(0.0, bytes(data))]

    return script


def mislengthened(by: int) -> Script:
    """The length of the frame is wrong."""

    def script(reply: bytes) -> list[Piece]:
        data = bytearray(reply)
        data[2] = (data[2] + by) % 256
        return [Piece(0.0, bytes(data))]

    return script


def preceded(data: bytes, *, is_report: bool = False) -> Script:
    """Noise, or a report, comes first."""
    return lambda reply: [Piece(0.0, data, is_report), Piece(0.0, reply)]


def followed(data: bytes, after: float = 0.0, *, is_report: bool = False) -> Script:
    """Noise, or a report, comes behind."""
    return lambda reply: [Piece(0.0, reply), Piece(after, data, is_report)]


def halted(size: int, pause: float) -> Script:
    """The reply comes in two pieces, with a pause between them, in which nothing else comes."""
    return lambda reply: [Piece(0.0, reply, size=size, pause=pause)]
