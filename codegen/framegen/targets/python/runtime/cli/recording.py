"""Reads what was recorded of a line: a log of `monitor`, a trace of a client, hex, raw bytes."""

from __future__ import annotations

import re
import sys
from typing import NamedTuple

from ..codec import decode
from ..decoder import StreamDecoder
from ..errors import DecodeError, Reason
from ..exchanges import RECEIVED
from ..noise import Noise
from .events import EITHER, NOISE, SENDERS, bytes_of, twins
from .hextext import looks_like_hex, parse_hex
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from ..direction import Direction
    from ..message import Message

# A line as Recorder and the client's Tap write it.
_LINE = re.compile(r"(?P<hex>[^#]*)# *(?P<at>[0-9]{1,9}(?:\.[0-9]{1,9})?) s, (?P<who>[^:]*): ")


class Heard(NamedTuple):
    """One event of a recording: where it stands, when it was, what it is, and who sent it.

    `at` is seconds, None where nobody noted the time. `sender` is one of SENDERS, or EITHER where
    nobody can tell; for noise, too.
    """

    place: str
    at: float | None
    event: Message | Noise
    sender: str


def read_recording(
    path: Path, form: str, direction: Direction | None, *, strict: bool
) -> list[Heard]:
    """All of a file, or of standard input for `-`. Raises UnusableError for what is malformed.

    `direction` is who sent the bytes, for a file that does not say so itself. If `strict`, a line
    must hold the frame of the sender that it names; or else its bytes are noise.
    """
    data = _bytes(path)
    name = "standard input" if str(path) == "-" else str(path)
    lines = data.decode("utf-8", errors="replace").splitlines()
    # A log is one by its comments, so that a slip in its hex is told as such.
    if form != "raw" and any(_LINE.match(line) for line in lines):
        return list(_logged(lines, name, strict=strict))
    if form == "raw" or (form == "auto" and not looks_like_hex(data)):
        return list(_streamed(data, name, direction))
    try:
        octets = b"".join(parse_hex(line) for line in lines)
    except UnusableError as error:
        raise UnusableError(f"{name}: {error}") from None
    return list(_streamed(octets, name, direction))


def _bytes(path: Path) -> bytes:
    try:
        return sys.stdin.buffer.read() if str(path) == "-" else path.read_bytes()
    except OSError as error:
        raise UnusableError(f"{path} cannot be read: {error.strerror or error}") from None


def _streamed(data: bytes, name: str, direction: Direction | None) -> Iterator[Heard]:
    """The events of a stream, each at its byte."""
    decoder = StreamDecoder(direction)
    offset = 0
    for event in [*decoder.feed(data), *decoder.flush()]:
        if isinstance(event, Noise):
            sender = EITHER if direction is None else direction.sender
        else:
            sender = EITHER if twins(event, direction) else event.DIRECTION.sender
        yield Heard(f"{name}, byte {offset}", None, event, sender)
        offset += len(bytes_of(event))


def _logged(lines: list[str], name: str, *, strict: bool) -> Iterator[Heard]:
    """The events of a log, each at its line."""
    before = 0.0
    for number, line in enumerate(lines, start=1):
        place = f"{name}, line {number}"
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        found = _LINE.match(line)
        if found is None:
            raise UnusableError(
                f"{place}: it has no time and sender, as in `55 55 02 07  # 0.5 s, NAME: ...`, "
                "and other lines have"
            )
        try:
            data = parse_hex(found["hex"])
        except UnusableError as error:
            raise UnusableError(f"{place}: {error}") from None
        at = float(found["at"])
        event, sender = _told(data, found["who"], place, strict=strict)
        # What came to this end may be told late: a client does so when it has opened a line anew.
        if RECEIVED is None or sender != RECEIVED.sender:
            if at < before:
                raise UnusableError(
                    f"{place}: {found['at']} s is before {before:.6f} s in a line above; "
                    "play the recordings one by one, or put their times in order"
                )
            before = at
        yield Heard(place, at, event, sender)


def _told(data: bytes, who: str, place: str, *, strict: bool) -> tuple[Message | Noise, str]:
    """What a line of a log says, and by whom. Raises UnusableError where its bytes disagree."""
    whose, _, noise = who.rpartition(" ")
    if noise == NOISE and whose in ("", EITHER, *SENDERS):
        # Where nobody is named, it came to this end: what a client sends is never noise.
        return _noise(data), whose or (EITHER if RECEIVED is None else RECEIVED.sender)
    if who != EITHER and who not in SENDERS:
        known = ", ".join([*SENDERS, EITHER, NOISE])
        raise UnusableError(f"{place}: {who!r} is none of those who send: {known}")
    try:
        return decode(data, SENDERS.get(who)), who
    except DecodeError as error:
        if not strict:
            return Noise(data, error.reason), who
        raise UnusableError(f"{place}: it is no frame of {who}: {error}") from None


def _noise(data: bytes) -> Noise:
    """Bytes that were no message when they were heard, whatever they are now."""
    try:
        decode(data, None)
    except DecodeError as error:
        return Noise(data, error.reason)
    return Noise(data, Reason.BAD_HEADER)
