"""The verb `replay`: sends what was recorded once more, at the pace at which it was recorded."""

from __future__ import annotations

import sys
from contextlib import closing
from pathlib import Path

from ..exchanges import EXCHANGES
from ..noise import Noise
from ..wire import Wire
from . import link
from .events import EITHER, NOISE, SENDERS, bytes_of, counted, in_words
from .exits import DONE, INTERRUPTED
from .lines import Lines
from .link import add_port, failures_told, open_line
from .numerals import above_zero
from .playback import Playback
from .recording import read_recording
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from .recording import Heard

ENDS = link.ENDS
ABOUT = """\
FILE is what `monitor --log` or the `trace` of a client wrote, or hex, or raw bytes. What this end
has sent in it is sent again: each frame at the time at which it was recorded, but no faster than
the line can carry it; raw bytes and plain hex have no times, and go as fast as that. What the board
sent is left out. What is no frame, or may be of either end, is refused before anything is sent,
unless an option says what to do with it. What is sent is printed, and so is what comes back.

The board does at once what it is told, within the limits of `send` or beyond them: give the arm
room, and look at --dry-run first."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declares the arguments of the verb."""
    parser.add_argument("file", type=Path, metavar="FILE", help="a recording; - is standard input")
    add_port(parser, required=False, client=False)
    parser.add_argument(
        "--speed",
        type=above_zero("number"),
        default=1.0,
        metavar="X",
        help="so many times as fast as it was recorded; inf: as fast as the line can (default: 1)",
    )
    parser.add_argument("--dry-run", action="store_true", help="print what would be sent, and when")
    parser.add_argument(
        "--direction",
        choices=[*SENDERS, "any"],
        default="any",
        help="who sent the bytes, where the file does not say (default: any)",
    )
    parser.add_argument(
        "--format",
        choices=["auto", "hex", "raw"],
        default="auto",
        help="what the file holds (default: auto, by its bytes)",
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
    """Sends what is to be sent; or only prints it."""
    port = arguments.port or ""
    if not port and not arguments.dry_run:
        raise UnusableError("replay needs --port PORT, or --dry-run to see what it would send")
    chosen = _chosen(arguments)
    times = _times(chosen, arguments.speed, arguments.baud)
    if arguments.dry_run:
        lines = Lines(sys.stdout)
        for heard, at in zip(chosen, times, strict=True):
            lines.show(heard.event, SENDERS.get(heard.sender), at)
        sizes = [len(bytes_of(heard.event)) for heard in chosen]
        taken = times[-1] + Wire(arguments.baud).seconds(sizes[-1])
        told = f"{counted(len(chosen), 'frame')}, {counted(sum(sizes), 'byte')} in {taken:.3f} s"
        print(f"{told}: nothing was sent", file=sys.stderr)
        return DONE
    with failures_told(), closing(open_line(port, arguments.baud)) as line:
        try:
            Playback(sys.stdout).play(line, chosen, times)
        except KeyboardInterrupt:
            return INTERRUPTED
    return DONE


def _chosen(arguments: argparse.Namespace) -> list[Heard]:
    """What is to be sent of a recording. Raises UnusableError for what must not be."""
    direction = SENDERS.get(arguments.direction)
    recorded = read_recording(arguments.file, arguments.format, direction, strict=not arguments.raw)
    chosen = [heard for heard in recorded if arguments.raw or _is_sent(heard, arguments)]
    kept = {id(heard) for heard in chosen}
    left = [heard for heard in recorded if id(heard) not in kept]
    if not chosen:
        raise UnusableError(f"{arguments.file} holds nothing to send; it holds {_kinds(left)}")
    if left:
        print(f"left out: {_kinds(left)}", file=sys.stderr)
    return chosen


def _is_sent(heard: Heard, arguments: argparse.Namespace) -> bool:
    """Whether it is for sending. Raises UnusableError where nobody could say so."""
    own = {kind.DIRECTION.sender for kind in EXCHANGES}
    if heard.sender not in {*own, EITHER}:
        return False
    what = in_words(heard.event, SENDERS.get(heard.sender))
    if isinstance(heard.event, Noise):
        if not arguments.skip_noise:
            raise UnusableError(
                f"{heard.place}: it is no frame ({what}); "
                "--skip-noise leaves out what is none, --raw sends every byte"
            )
        return False
    if heard.sender == EITHER and arguments.either is None:
        raise UnusableError(
            f"{heard.place}: it is {what}, and nobody can tell whose; --either send sends such "
            "frames, --either skip leaves them out, and of a file that names no senders "
            f"--direction {' or '.join(own)} says that all of it is from here"
        )
    return heard.sender != EITHER or arguments.either == "send"


def _kinds(recorded: list[Heard]) -> str:
    """How much there is of each kind, in words."""
    found: dict[str, int] = {}
    for heard in recorded:
        kind = NOISE if isinstance(heard.event, Noise) else heard.sender
        found[kind] = found.get(kind, 0) + 1
    pieces = found.pop(NOISE, 0)
    told = [f"{counted(number, 'frame')} of {sender}" for sender, number in found.items()]
    told += [f"{counted(pieces, 'piece')} of noise"] if pieces else []
    return ", ".join(told) or "nothing at all"


def _times(chosen: list[Heard], speed: float, baud: float) -> list[float]:
    """When each is sent, in seconds from the first on: as recorded, one after the other."""
    wire = Wire(baud)
    first = chosen[0].at or 0.0
    times = [first if heard.at is None else heard.at for heard in chosen]
    return [
        wire.take(len(bytes_of(heard.event)), (at - first) / speed)
        for heard, at in zip(chosen, times, strict=True)
    ]
