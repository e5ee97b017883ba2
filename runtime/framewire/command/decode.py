"""The verb `decode`: the meaning of bytes, frame by frame, with nothing left out."""

from __future__ import annotations

import sys
from argparse import ArgumentTypeError
from pathlib import Path

from ..codec.counters import Counters
from ..codec.event_bytes import bytes_of
from ..codec.hextext import is_hex
from .capture import add_capture, direction_in, is_file, opened_capture
from .entries import EntryLines
from .events import counted, totals
from .exit_codes import DONE, NOT_ALL
from .extra import imported
from .lines import TIMES
from .look_alike import ENOUGH, hint
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from ..codec.protocol_codec import ProtocolCodec
    from .program import Program

ENDS = {NOT_ALL: "there was noise, and --strict was given"}
ABOUT = """\
FILE is what `monitor --log` or the `trace` of a client recorded, or hex, or raw bytes. A recording
says who has sent what, and when: each of its lines is decoded as its sender's.
--csv prints all events as one table, --csv-tables writes a table for each message.
--parquet and --arrow take the extra `tables`."""


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    add_capture(parser, program.library.codec)
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
    form.add_argument(
        "--csv-tables",
        type=_target,
        metavar="DIR",
        help="write a table for each message and one of noise into a folder, as CSV files",
    )
    form.add_argument(
        "--parquet",
        type=_target,
        metavar="DIR",
        help="write a table for each message and one of noise into a folder, as Parquet files",
    )
    form.add_argument(
        "--arrow",
        type=_target,
        metavar="FILE",
        help="write all events in order into one file, in Arrow's format",
    )
    parser.add_argument("--strict", action="store_true", help="exit with 1 if there was any noise")


def run(arguments: Namespace, program: Program) -> int:
    """Print every message and all noise, or write tables; and the totals on the error stream."""
    codec, seen = program.library.codec, Counters(0, 0, 0, 0)
    targets = arguments.csv_tables, arguments.parquet, arguments.arrow
    if any(target is not None for target in targets):
        if arguments.time is not None:
            raise UsageError("-t is for what is printed; tables hold every time")
        begun = imported("table_files", codec.package).write_tables(arguments, seen, codec)
    else:
        _refuse_folder(arguments)
        begun = _print(arguments, seen, codec)
    print(totals(seen), file=sys.stderr)
    if 2 * seen.noise > seen.fed:
        hint(begun, codec)
    return NOT_ALL if arguments.strict and seen.noise else DONE


def _target(word: str) -> Path:
    """Return what tables are written to; a word that reads as input was hardly meant to be that."""
    if word == "-":
        raise ArgumentTypeError(
            "tables cannot be written to standard output: name a folder or file"
        )
    if is_hex(word):
        raise ArgumentTypeError(
            f"{word[:40]!r} reads as bytes in hex: give the name to write to first, "
            "and write one that is hex with ./ before it"
        )
    return Path(word)


def _refuse_folder(arguments: Namespace) -> None:
    """Refuse a folder behind --csv, which prints: the word would be taken for bytes."""
    files = [word for word in arguments.input if is_file(word)]
    others = [word for word in arguments.input if word not in files and not is_hex(word)]
    if arguments.csv and files and others:
        raise UsageError(
            f"--csv prints rows, and {others[0]!r} is no input: "
            f"--csv-tables {others[0]} writes a folder of CSV files"
        )


def _print(arguments: Namespace, seen: Counters, codec: ProtocolCodec) -> bytes:
    """Print every event, and count it; return how the bytes begin."""
    form = "json" if arguments.json else "csv" if arguments.csv else "text"
    lines = EntryLines(sys.stdout, form, codec, arguments.time)
    begun = b""
    with opened_capture(arguments, codec) as (recording, holds):
        entries = recording.entries(holds, direction_in(arguments, codec))
        for entry in counted(entries, seen):
            lines.show(entry)
            if len(begun) < ENOUGH:
                begun += bytes_of(entry.event)
    sys.stdout.flush()
    if arguments.time is not None:
        for problem in lines.problems(recording.name):
            print(problem, file=sys.stderr)
    return begun
