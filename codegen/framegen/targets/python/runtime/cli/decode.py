"""The verb `decode`: what bytes mean, frame by frame, with nothing left out."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from ..decoder import StreamDecoder
from ..octets import spaced
from .events import SENDERS, as_record, bytes_of, in_words, sender_of, totals
from .exits import DONE, NOT_ALL
from .hextext import QUIET, looks_like_hex, parse_hex
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator
    from typing import BinaryIO

    from ..direction import Direction
    from ..message import Message
    from ..noise import Noise

ENDS = {NOT_ALL: "there was noise, and --strict was given"}
_CHUNK = 65536


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
        choices=[*SENDERS, "any"],
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
    direction = SENDERS.get(arguments.direction)
    decoder = StreamDecoder(direction)
    show = event_as_json if arguments.json else event_as_text
    offset = 0
    for events in _decoded(decoder, _chunks(arguments)):
        for event in events:
            print(show(event, offset, direction))
            offset += len(bytes_of(event))
        sys.stdout.flush()
    print(totals(decoder.counters), file=sys.stderr)
    return NOT_ALL if arguments.strict and decoder.counters.noise else DONE


def _decoded(
    decoder: StreamDecoder, chunks: Iterator[bytes | None]
) -> Iterator[list[Message | Noise]]:
    for chunk in chunks:
        yield decoder.flush() if chunk is None else decoder.feed(chunk)
    yield decoder.flush()


def _chunks(arguments: Namespace) -> Iterator[bytes | None]:
    """The bytes to decode, as they come; None where a log says that the line was quiet."""
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


def _read(stream: BinaryIO, form: str) -> Iterator[bytes | None]:
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
            text = line.decode("utf-8", errors="replace")
            yield None if text.strip() == QUIET else parse_hex(text)
        first = read_some(_CHUNK)
        rest += first
    yield parse_hex(rest.decode("utf-8", errors="replace"))


def event_as_text(event: Message | Noise, offset: int, direction: Direction | None) -> str:
    """A line of text for people."""
    who, what = sender_of(event, direction), in_words(event, direction)
    return f"{offset:6}  {who:10}  {what} | {spaced(bytes_of(event))}"


def event_as_json(event: Message | Noise, offset: int, direction: Direction | None) -> str:
    """A line of JSON."""
    return json.dumps({"offset": offset} | as_record(event, direction))
