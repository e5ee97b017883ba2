"""The verb `replay`: sends a recording once more, at the pace at which it was recorded."""

from __future__ import annotations

import sys
from contextlib import closing
from pathlib import Path

from .._client.exchanges import EXCHANGES
from .._client.wire_time import WireTime
from .._codec.event_bytes import bytes_of
from .._codec.noise import Noise
from .._frame.direction import RECEIVED
from .._frame.pluralize import pluralize
from .._library import CODEC, LINK
from .._recording.ends import ends_of
from .._recording.file import EITHER, NOISE
from .._recording.form import FORMS
from . import link
from .events import in_words
from .exit_codes import DONE, INTERRUPTED
from .lines import Lines
from .link import add_port, failures_reported, open_line, port_of
from .numerals import above_zero
from .playback import Playback
from .recording import opened
from .rereading import rereadable
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterable, Iterator

    from .._recording.entry import Entry

ENDS = link.ENDS
ABOUT = """\
FILE is what `monitor --log` or the `trace` of a client wrote, or hex, or raw bytes. What this end
has sent in it is sent again: each frame at the time at which it was recorded, but no faster than
the line can carry it; raw bytes and plain hex have no times, and go as fast as that. What the
device sent is left out. What is no frame, or may be of either end, is refused before anything is
sent, unless an option says what to do with it. What is sent is printed, and so is what comes back.

The device does at once what is sent, within the limits of `send` or beyond them: give it
room, and look at --dry-run first."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording; - is standard input")
    add_port(parser, client=False)
    parser.add_argument(
        "--speed",
        type=above_zero(),
        default=1.0,
        metavar="X",
        help="so many times as fast as it was recorded; inf: as fast as the line can (default: 1)",
    )
    parser.add_argument("--dry-run", action="store_true", help="print what would be sent, and when")
    parser.add_argument(
        "--direction",
        choices=[*ends_of(CODEC).named, "any"],
        default="any",
        help="who sent the bytes, where the file does not say (default: any)",
    )
    parser.add_argument(
        "--format",
        choices=FORMS,
        default="auto",
        help="what the file holds (default: auto, by its first word)",
    )
    parser.add_argument(
        "--either",
        choices=["send", "skip"],
        help="what to do with frames that either end may have sent (default: refuse the file)",
    )
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--skip-noise", action="store_true", help="leave out what is no frame")
    what.add_argument(
        "--raw", action="store_true", help="send every byte, whoever sent it, noise and all"
    )


def run(arguments: argparse.Namespace) -> int:
    """Send the chosen entries, or only print them."""
    port = "" if arguments.dry_run else port_of(arguments)
    direction = ends_of(CODEC).named.get(arguments.direction)
    with opened(arguments.file) as given, rereadable(given) as recording:
        # All of it is checked before any of it is sent.
        count = _survey(recording.entries(arguments.format, direction), recording.name, arguments)
        entries = (
            entry
            for entry in recording.entries(arguments.format, direction)
            if _is_chosen(entry, recording.name, arguments)
        )
        timed = _timed(entries, arguments.speed, arguments.baud)
        if arguments.dry_run:
            _show(timed, arguments.baud)
            return DONE
        with failures_reported(arguments), closing(open_line(port, arguments.baud)) as line:
            try:
                Playback(sys.stdout).play(line, timed, count)
            except KeyboardInterrupt:
                return INTERRUPTED
    return DONE


def _survey(entries: Iterable[Entry], name: str, arguments: argparse.Namespace) -> int:
    """Return how many entries are sent. Raises UsageError for a bad one, or if there is none."""
    before = 0.0
    chosen = 0
    left: dict[str, int] = {}
    for entry in entries:
        # A client may record late what it has received, as when it has reopened a line.
        if entry.time is not None and entry.sender != RECEIVED.sender:
            if entry.time < before:
                raise UsageError(
                    f"{name}, {entry.place}: {entry.time:.6f} s is before {before:.6f} s in a line "
                    "above; play the recordings one by one, or put their times in order"
                )
            before = entry.time
        if _is_chosen(entry, name, arguments):
            chosen += 1
        else:
            kind = NOISE if isinstance(entry.event, Noise) else entry.sender or EITHER
            left[kind] = left.get(kind, 0) + 1
    if not chosen:
        raise UsageError(f"{arguments.file} holds nothing to send; it holds {_kinds(left)}")
    if left:
        print(f"left out: {_kinds(left)}", file=sys.stderr)
    return chosen


def _is_chosen(entry: Entry, name: str, arguments: argparse.Namespace) -> bool:
    """Return whether an entry is sent. Raises UsageError if that is undecided."""
    own = {kind.DIRECTION.sender for kind in EXCHANGES}
    if arguments.raw:
        return True
    if entry.sender not in {*own, None}:
        return False
    what = in_words(entry.event, entry.direction)
    if isinstance(entry.event, Noise):
        if not arguments.skip_noise:
            raise UsageError(
                f"{name}, {entry.place}: it is no frame ({what}); "
                "--skip-noise leaves out what is none, --raw sends every byte"
            )
        return False
    if entry.sender is None and arguments.either is None:
        names = [name for name, way in ends_of(CODEC).named.items() if way.sender in own]
        raise UsageError(
            f"{name}, {entry.place}: it is {what}, and nothing shows who sent it; --either send "
            "sends such frames, --either skip leaves them out, and of a file that names no senders "
            f"--direction {' or '.join(names)} says that all of it is from here"
        )
    return entry.sender is not None or arguments.either == "send"


def _kinds(found: dict[str, int]) -> str:
    """Return how many there are of each kind, in words."""
    senders = [(sender, number) for sender, number in found.items() if sender != NOISE]
    kinds = [f"{pluralize(number, 'frame')} of {sender}" for sender, number in senders]
    kinds += [f"{pluralize(found[NOISE], 'piece')} of noise"] if NOISE in found else []
    return ", ".join(kinds) or "nothing at all"


def _timed(entries: Iterable[Entry], speed: float, baud: float) -> Iterator[tuple[Entry, float]]:
    """Yield each entry with its time, in seconds from the first: as recorded, without overlap."""
    wire = WireTime(LINK, baud)
    first: float | None = None
    for entry in entries:
        at = entry.time or 0.0
        first = at if first is None else first
        yield entry, wire.take(len(bytes_of(entry.event)), (at - first) / speed)


def _show(timed: Iterable[tuple[Entry, float]], baud: float) -> None:
    """Print what would be sent, and when."""
    lines, wire = Lines(sys.stdout), WireTime(LINK, baud)
    size, ends = 0, 0.0
    for entry, at in timed:
        lines.show(entry.event, entry.direction, at)
        size += len(bytes_of(entry.event))
        ends = at + wire.seconds(len(bytes_of(entry.event)))
    summary = f"{pluralize(lines.count, 'frame')}, {pluralize(size, 'byte')} in {ends:.3f} s"
    print(f"{summary}: nothing was sent", file=sys.stderr)
