"""`framegen guess`: prints a spec to begin from, guessed from a recording."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.recording.form import FORMS

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

SUMMARY = "Guess a spec to begin from, by a recording of a line whose protocol is unknown."
EXAMPLES = (
    ("framegen guess line.bin", "print it, with what is undecided in its comments"),
    ("framegen guess line.bin > spec/kiln.yaml", "begin with it"),
    ("framegen guess frames.hex", "hex, which tells most with a frame a line"),
)
ABOUT = (
    "It tries constant bytes, lengths, checksums of the catalogue and ids in all combinations, and "
    "says what fits equally. Some 200 frames, of several devices, decide most."
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "file",
        metavar="FILE",
        help="raw bytes, or hex as text, such as a recording; - is standard input",
    )
    parser.add_argument(
        "--input",
        choices=FORMS,
        default="auto",
        help="what the file holds (default: auto, by its first word)",
    )


def run(arguments: Namespace) -> int:
    """Print the spec. 0 for one, 1 where nothing shows what frames are. Raises Unusable."""
    from framegen.commands.capture_argument import content  # noqa: PLC0415
    from framegen.guess.capture import read_capture  # noqa: PLC0415
    from framegen.guess.explained import explained  # noqa: PLC0415
    from framegen.guess.guess import guess  # noqa: PLC0415
    from framegen.guess.spec_text import spec_text  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    name = "standard input" if arguments.file == "-" else visible(arguments.file)
    try:
        capture = read_capture(content(arguments.file), arguments.input)
    except ValueError as error:
        raise Unusable(f"{name}, {error}", hint="raw bytes need --input raw") from None
    if not capture.data:
        raise Unusable(f"{name} is empty", hint="record some 200 frames of the line")
    found = guess(capture)
    if found is None:
        print(f"undecided: nothing in {name} shows where frames begin", file=sys.stderr)
        return 1
    share = explained(spec_text(found, name), capture)
    print(spec_text(found, name, share), end="")
    return 0
