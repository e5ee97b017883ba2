"""The verb `replay`: sends a recording once more, at the pace at which it was recorded."""

from __future__ import annotations

import sys
from contextlib import closing
from pathlib import Path

from ..client.wire_time import WireTime
from ..codec.event_bytes import bytes_of
from ..codec.noise import Noise
from ..frame.pluralize import pluralize
from ..recording.file import EITHER, NOISE
from ..recording.form import FORMS
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

    from ..client.library import Library
    from ..codec.protocol_codec import ProtocolCodec
    from ..recording.entry import Entry
    from .program import Program

ENDS = link.ENDS
ABOUT = """\
FILE is what `monitor --log` or the `trace` of a client wrote, or hex, or raw bytes. What this end
has sent in it is sent again: each frame at the time at which it was recorded, but no faster than
the line can carry it; raw bytes and plain hex have no times, and go as fast as that. What the
device sent is left out. What is no frame, or may be of either end, is refused before anything is
sent, unless an option says what to do with it. What is sent is printed, and so is what comes back.

The device does at once what is sent, within the limits of `send` or beyond them: give it
room, and look at --dry-run first."""


def add_arguments(parser: argparse.ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording; - is standard input")
    add_port(parser, program, client=False)
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
        choices=[*program.library.codec.named, "any"],
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


def run(arguments: argparse.Namespace, program: Program) -> int:
    """Send the chosen entries, or only print them."""
    port = "" if arguments.dry_run else port_of(arguments, program)
    codec = program.library.codec
    direction = codec.named.get(arguments.direction)
    with opened(arguments.file, codec) as given, rereadable(given) as recording:
        # All of it is checked before any of it is sent.
        choice = _Choice(arguments, recording.name, program.library)
        count = choice.survey(recording.entries(arguments.format, direction))
        entries = filter(choice.has, recording.entries(arguments.format, direction))
        wire = WireTime(program.library.link, arguments.baud)
        timed = _timed(entries, arguments.speed, wire)
        if arguments.dry_run:
            _show(timed, wire, codec)
            return DONE
        with (
            failures_reported(arguments),
            closing(open_line(port, arguments.baud, program.library)) as line,
        ):
            try:
                Playback(sys.stdout, codec).play(line, timed, count)
            except KeyboardInterrupt:
                return INTERRUPTED
    return DONE


class _Choice:
    """What of a recording is sent."""

    def __init__(self, arguments: argparse.Namespace, name: str, library: Library) -> None:
        self._arguments = arguments
        self._name = name
        self._codec = library.codec
        self._received = library.codec.received.sender
        self._own = {kind.DIRECTION.sender for kind in library.exchanges}

    def survey(self, entries: Iterable[Entry]) -> int:
        """Return how many are sent. Raises UsageError for a bad one, or if there is none."""
        before = 0.0
        chosen = 0
        left: dict[str, int] = {}
        for entry in entries:
            # A client may record late what it has received, as when it has reopened a line.
            if entry.time is not None and entry.sender != self._received:
                if entry.time < before:
                    raise UsageError(
                        f"{self._name}, {entry.place}: {entry.time:.6f} s is before {before:.6f} s "
                        "in a line above; play the recordings one by one, or put their times in "
                        "order"
                    )
                before = entry.time
            if self.has(entry):
                chosen += 1
            else:
                kind = NOISE if isinstance(entry.event, Noise) else entry.sender or EITHER
                left[kind] = left.get(kind, 0) + 1
        if not chosen:
            raise UsageError(
                f"{self._arguments.file} holds nothing to send; it holds {_kinds(left)}"
            )
        if left:
            print(f"left out: {_kinds(left)}", file=sys.stderr)
        return chosen

    def has(self, entry: Entry) -> bool:
        """Return whether an entry is sent. Raises UsageError if that is undecided."""
        if self._arguments.raw:
            return True
        if entry.sender not in {*self._own, None}:
            return False
        what = in_words(entry.event, entry.direction, self._codec)
        if isinstance(entry.event, Noise):
            if not self._arguments.skip_noise:
                raise UsageError(
                    f"{self._name}, {entry.place}: it is no frame ({what}); "
                    "--skip-noise leaves out what is none, --raw sends every byte"
                )
            return False
        if entry.sender is None and self._arguments.either is None:
            names = [name for name, way in self._codec.named.items() if way.sender in self._own]
            raise UsageError(
                f"{self._name}, {entry.place}: it is {what}, and nothing shows who sent it; "
                "--either send sends such frames, --either skip leaves them out, and of a file "
                f"that names no senders --direction {' or '.join(names)} says that all of it is "
                "from here"
            )
        return entry.sender is not None or self._arguments.either == "send"


def _kinds(found: dict[str, int]) -> str:
    """Return how many there are of each kind, in words."""
    senders = [(sender, number) for sender, number in found.items() if sender != NOISE]
    kinds = [f"{pluralize(number, 'frame')} of {sender}" for sender, number in senders]
    kinds += [f"{pluralize(found[NOISE], 'piece')} of noise"] if NOISE in found else []
    return ", ".join(kinds) or "nothing at all"


def _timed(entries: Iterable[Entry], speed: float, wire: WireTime) -> Iterator[tuple[Entry, float]]:
    """Yield each entry with its time, in seconds from the first: as recorded, without overlap."""
    first: float | None = None
    for entry in entries:
        at = entry.time or 0.0
        first = at if first is None else first
        yield entry, wire.take(len(bytes_of(entry.event)), (at - first) / speed)


def _show(timed: Iterable[tuple[Entry, float]], wire: WireTime, codec: ProtocolCodec) -> None:
    """Print what would be sent, and when."""
    lines = Lines(sys.stdout, codec)
    size, ends = 0, 0.0
    for entry, at in timed:
        lines.show(entry.event, entry.direction, at)
        size += len(bytes_of(entry.event))
        ends = at + wire.seconds(len(bytes_of(entry.event)))
    summary = f"{pluralize(lines.count, 'frame')}, {pluralize(size, 'byte')} in {ends:.3f} s"
    print(f"{summary}: nothing was sent", file=sys.stderr)
