"""The verb `stats`: what a line carried, in numbers, and its readings over time as a drawing."""

from __future__ import annotations

import sys
from pathlib import Path

from .capture import add_capture, direction_in, opened_capture
from .excerpts import add_excerpt, excerpt_of
from .exit_codes import DONE
from .extra import imported
from .look_alike import beginning, hint
from .numerals import at_least, ranges
from .statistics_sheet import as_json, show
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from .program import Program

ABOUT = """\
Counts and shares of each message, noise by reason, and the range of each value; of a recording
also rates, gaps, and how much of what the line allows was used. It takes the extra `tables`, and
--plot the extra `plots`."""
# The highest number that --ids takes: no bus has as many addresses.
_HIGHEST = 65535
_SUFFIXES = (".svg", ".png", ".pdf")


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    usual = program.library.link.baud
    add_capture(parser, program.library.codec)
    parser.add_argument(
        "--baud",
        type=at_least(1),
        default=usual,
        metavar="BAUD",
        help=f"the rate of the line, for its load (default: {usual})",
    )
    add_excerpt(parser)
    parser.add_argument(
        "--ids",
        type=_ids,
        metavar="1-6,9",
        help="of values that are measured of several numbers, only those of these",
    )
    parser.add_argument(
        "--plot",
        type=Path,
        metavar="FILE",
        help=f"also draw the readings over time; FILE ends with {' or '.join(_SUFFIXES)}",
    )
    parser.add_argument("--json", action="store_true", help="print a line of JSON")


def run(arguments: Namespace, program: Program) -> int:
    """Print the statistics, and draw the readings if that is asked for."""
    plot: Path | None = arguments.plot
    baud: int = arguments.baud
    codec, link = program.library.codec, program.library.link
    # What cannot work is reported before a long file is read.
    excerpt = excerpt_of(arguments)
    if plot is not None:
        _refuse(plot)
    measuring = imported("measuring", codec.package, "tables")
    drawing = None if plot is None else imported("drawing", codec.package, "tables", "plots")
    with opened_capture(arguments, codec) as (recording, form):
        recording.is_quiet = True
        with recording.from_the_beginning():
            found, traces = measuring.measured(recording, form, arguments, link)
        mostly_noise = 2 * found.noise_size > found.size
        direction = direction_in(arguments, codec)
        begun = beginning(recording, form, direction) if mostly_noise else b""
    name = recording.name if excerpt is None else f"{recording.name} {excerpt.words}"
    print(as_json(found, baud, link)) if arguments.json else show(found, name, baud, link)
    sys.stdout.flush()
    hint(begun, codec)
    measured = {each.key for each in found.ranges}
    absent = [str(each) for each in arguments.ids or () if each not in measured]
    if absent:
        print(f"no value is measured of {', '.join(absent)}", file=sys.stderr)
    if drawing is not None:
        for note in drawing.drawn(traces, plot, name, baud, codec):
            print(note, file=sys.stderr)
    return DONE


def _ids(text: str) -> tuple[int, ...]:
    return ranges(text, 0, _HIGHEST)


def _refuse(plot: Path) -> None:
    """Raise UsageError for a drawing that cannot be made."""
    if plot.suffix.lower() not in _SUFFIXES:
        known = ", ".join(_SUFFIXES)
        raise UsageError(f"{plot} cannot be drawn: its name has to end with one of {known}")
    if not plot.parent.is_dir():
        raise UsageError(f"{plot} cannot be written: there is no folder {plot.parent}")
