"""The verb `decode`: what bytes mean, frame by frame, with nothing left out."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from ..codec import table_for
from ..decoder import StreamDecoder
from ..direction import Direction
from ..errors import DecodeError
from ..messages import MESSAGES
from ..noise import Noise, UnknownFrame
from ..octets import spaced
from .hextext import looks_like_hex, parse_hex
from .unusable import UnusableError
from .values import fields_as_json, fields_as_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator
    from typing import Any, BinaryIO

    from ..message import Message

_CHUNK = 65536
_SENDERS = {direction.sender: direction for direction in Direction}


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the arguments of the verb."""
    parser.add_argument(
        "input",
        nargs="*",
        metavar="HEX|FILE",
        help="bytes in hex, or one file of hex or raw bytes; - or nothing is standard input",
    )
    parser.add_argument("--file", type=Path, metavar="FILE", help="a file, whatever its name")
    parser.add_argument(
        "--direction",
        choices=[*_SENDERS, "any"],
        default="any",
        help="who sent the bytes (default: any)",
    )
    parser.add_argument(
        "--format",
        choices=["auto", "hex", "raw"],
        default="auto",
        help="what a file or standard input holds (default: auto, by its first bytes)",
    )
    parser.add_argument("--json", action="store_true", help="print each event as a line of JSON")
    parser.add_argument("--strict", action="store_true", help="exit with 1 if there was any noise")


def run(arguments: Namespace) -> int:
    """Prints every message and all noise, and to the error stream the totals."""
    direction = _SENDERS.get(arguments.direction)
    decoder = StreamDecoder(direction)
    show = event_as_json if arguments.json else event_as_text
    offset = 0
    for events in _decoded(decoder, _chunks(arguments)):
        for event in events:
            print(show(event, offset, direction))
            offset += len(_bytes_of(event))
        sys.stdout.flush()
    seen = decoder.counters
    unknown = (
        f", {_counted(seen.unknown_frames, 'unknown frame')} in it" if seen.unknown_frames else ""
    )
    totals = f"{_counted(seen.fed, 'byte')}: {_counted(seen.messages, 'message')}"
    print(f"{totals}, {_counted(seen.noise, 'byte')} of noise{unknown}", file=sys.stderr)
    return 1 if arguments.strict and seen.noise else 0


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def _decoded(decoder: StreamDecoder, chunks: Iterator[bytes]) -> Iterator[list[Message | Noise]]:
    for chunk in chunks:
        yield decoder.feed(chunk)
    yield decoder.flush()


def _bytes_of(event: Message | Noise) -> bytes:
    return event.data if isinstance(event, Noise) else event.encode()


def _chunks(arguments: Namespace) -> Iterator[bytes]:
    """The bytes to decode, as they come."""
    words: list[str] = arguments.input
    file: Path | None = arguments.file
    if file is not None and words:
        raise UnusableError("give either --file or bytes, not both")
    if file is None and len(words) == 1 and words[0] != "-" and _is_file(words[0]):
        file = Path(words[0])
    if file is not None and str(file) != "-":
        try:
            with file.open("rb") as stream:
                yield from _read(stream, arguments.format)
        except OSError as error:
            raise UnusableError(f"{file} cannot be read: {error.strerror or error}") from None
    elif words and words != ["-"]:
        try:
            yield parse_hex(" ".join(words))
        except UnusableError as error:
            other = f", and there is no file {words[0]!r}" if len(words) == 1 else ""
            raise UnusableError(f"{error}{other}") from None
    else:
        yield from _read(sys.stdin.buffer, arguments.format)


def _is_file(word: str) -> bool:
    """Whether a word names a file, rather than bytes."""
    try:
        return not looks_like_hex(word.encode()) and Path(word).is_file()
    except (OSError, ValueError):
        return False


def _read(stream: BinaryIO, form: str) -> Iterator[bytes]:
    """A stream's bytes as they arrive; hex is read line by line."""
    # read1 gives what there is: on a live line nobody waits for a full buffer.
    read_some = getattr(stream, "read1", stream.read)
    first: bytes = read_some(_CHUNK)
    # A full chunk may end in the middle of two digits; its whole lines tell as much.
    shown = first[: first.rfind(b"\n") + 1] if len(first) == _CHUNK else first
    if form == "raw" or (form == "auto" and not looks_like_hex(shown or first)):
        while first:
            yield first
            first = read_some(_CHUNK)
        return
    rest = first
    while first:
        *lines, rest = rest.split(b"\n")
        for line in lines:
            yield parse_hex(line.decode("utf-8", errors="replace"))
        first = read_some(_CHUNK)
        rest += first
    yield parse_hex(rest.decode("utf-8", errors="replace"))


def event_as_text(event: Message | Noise, offset: int, direction: Direction | None) -> str:
    """A line of text for people."""
    if isinstance(event, UnknownFrame):
        told = f"command={event.command} parameters={spaced(event.parameters) or 'none'}"
        return f"{offset:6}  {'unknown':10}  {told} | {spaced(event.data)}"
    if isinstance(event, Noise):
        return f"{offset:6}  {'noise':10}  {_why(event, direction)} | {spaced(event.data)}"
    kinds = [type(event), *_twins(event, direction)]
    sender = event.DIRECTION.sender if len(kinds) == 1 else "either"
    name = " or ".join(kind.__name__ for kind in kinds)
    told = " ".join(part for part in (name, fields_as_text(event)) if part)
    return f"{offset:6}  {sender:10}  {told} | {spaced(event.encode())}"


def event_as_json(event: Message | Noise, offset: int, direction: Direction | None) -> str:
    """A line of JSON."""
    record: dict[str, Any] = {"offset": offset}
    if isinstance(event, Noise):
        record |= {"noise": spaced(event.data), "reason": event.reason.value}
        if isinstance(event, UnknownFrame):
            record |= {"command": event.command, "parameters": spaced(event.parameters)}
        return json.dumps(record)
    record |= {"direction": event.DIRECTION.value, "message": type(event).__name__}
    record |= {"fields": fields_as_json(event), "hex": spaced(event.encode())}
    twins = [twin.__name__ for twin in _twins(event, direction)]
    if twins:
        record["or"] = twins
    return json.dumps(record)


def _twins(message: Message, direction: Direction | None) -> list[type[Message]]:
    """The other messages that the same frame may be, where the direction is not known."""
    if direction is not None:
        return []
    found: list[type[Message]] = []
    for kind in MESSAGES:
        if kind.COMMAND == message.COMMAND and kind is not type(message):
            try:
                kind.decode(message.encode())
            except DecodeError:
                continue
            found.append(kind)
    return found


def _why(noise: Noise, direction: Direction | None) -> str:
    """The reason, and what was expected, where the bytes themselves tell."""
    try:
        table_for(direction).read(noise.data)
    except DecodeError as error:
        if error.reason is noise.reason:
            return f"{noise.reason.value}: {error.problem}"
    return noise.reason.value
