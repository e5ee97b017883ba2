"""The verb `decode`: the meaning of bytes, frame by frame, with nothing left out."""

from __future__ import annotations

import io
import sys
from contextlib import contextmanager
from pathlib import Path

from .._codec.counters import Counters
from .._codec.hextext import HexError, is_hex, read_hex
from .._codec.lookalikes import recognise
from .._codec.noise import Noise, UnknownFrame
from .._recording.entry import SENDERS
from ..recordings import FORMS
from .entries import EntryLines
from .events import bytes_of, totals
from .exit_codes import DONE, NOT_ALL
from .lines import TIMES
from .recording import Recording, opened
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from .._frame.message import Message

ENDS = {NOT_ALL: "there was noise, and --strict was given"}
ABOUT = """\
FILE is what `monitor --log` or the `trace` of a client recorded, or hex, or raw bytes. A recording
says who has sent what, and when: each of its lines is decoded as its sender's."""
# Bytes enough to recognise another protocol by.
_KEPT = 16384


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
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
        help="who sent the bytes, where they do not say so themselves (default: any)",
    )
    parser.add_argument(
        "--format",
        choices=FORMS,
        default="auto",
        help="what a file or standard input holds (default: auto, by its first word)",
    )
    parser.add_argument(
        "-t",
        choices=TIMES,
        dest="time",
        help="of a recording: the time of day, seconds since the line before, or since the start "
        "(default: zero)",
    )
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--json", action="store_true", help="print each event as a line of JSON")
    form.add_argument(
        "--csv", action="store_true", help="print each event as a row of CSV, the fields as JSON"
    )
    parser.add_argument("--strict", action="store_true", help="exit with 1 if there was any noise")


def run(arguments: Namespace) -> int:
    """Print every message and all noise, and the totals on the error stream."""
    form = "json" if arguments.json else "csv" if arguments.csv else "text"
    lines = EntryLines(sys.stdout, form, arguments.time)
    seen, begun = Counters(0, 0, 0, 0), b""
    with _recording(arguments) as (recording, holds):
        for entry in recording.entries(holds, SENDERS.get(arguments.direction)):
            lines.show(entry)
            data = bytes_of(entry.event)
            _count(seen, entry.event, len(data))
            if len(begun) < _KEPT:
                begun += data
    sys.stdout.flush()
    if arguments.time is not None:
        for problem in lines.problems(recording.name):
            print(problem, file=sys.stderr)
    print(totals(seen), file=sys.stderr)
    found = recognise(begun) if 2 * seen.noise > seen.fed else None
    if found is not None:
        title = found.removeprefix("The ")
        print(f"hint: most of it is noise; it looks like the {title}", file=sys.stderr)
    return NOT_ALL if arguments.strict and seen.noise else DONE


def _count(seen: Counters, event: Message | Noise, size: int) -> None:
    seen.fed += size
    if isinstance(event, Noise):
        seen.noise += size
        seen.unknown_frames += isinstance(event, UnknownFrame)
    else:
        seen.messages += 1


@contextmanager
def _recording(arguments: Namespace) -> Iterator[tuple[Recording, str]]:
    """Open the input, and return it with its form."""
    words: list[str] = arguments.input
    file: Path | None = arguments.file
    if file is not None and words:
        raise UsageError("give either --file or bytes, not both")
    if file is None and len(words) == 1 and words[0] != "-" and _is_file(words[0]):
        file = Path(words[0])
    if file is None and words and words != ["-"]:
        try:
            data = read_hex(" ".join(words))
        except HexError as error:
            other = f", and there is no file {words[0]!r}" if len(words) == 1 else ""
            raise UsageError(f"{error}{other}") from None
        yield Recording(io.BytesIO(data), "the command line"), "raw"
        return
    with opened(file or Path("-")) as recording:
        yield recording, arguments.format


def _is_file(word: str) -> bool:
    """Return whether a word names a file, rather than bytes."""
    try:
        return not is_hex(word) and Path(word).is_file()
    except (OSError, ValueError):
        return False
