"""`framegen audit`: holds recordings of a line against a spec."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.recording.form import FORMS

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from framegen.audit.recording import Recording
    from framegen.model.model import Model

SUMMARY = "Hold recordings against a spec: what they cover, what does not fit, what they settle."
EXAMPLES = (
    ("framegen audit busservo line.hex", "what it covers; 1 if something does not fit"),
    ("framegen audit busservo report.hex line.bin", "several at once, a doctor's report too"),
    ("framegen audit busservo rx.bin --direction controller", "raw bytes that one end sent"),
    ("framegen audit busservo line.hex --tolerate 1%", "a little noise is no finding"),
    ("framegen audit busservo line.hex --format markdown", "to be pasted into an issue"),
    ("framegen audit busservo --evidence", "how much of the spec was seen on hardware"),
)
_TOLERATED = re.compile(r"([0-9]{1,12})|([0-9]{1,2}(?:\.[0-9]{1,6})?|100)%")


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.usage = (
        "framegen audit SPEC CAPTURE ... [OPTIONS]\n       framegen audit SPEC --evidence"
    )
    parser.add_argument("spec", type=Path, metavar="SPEC", help="a spec file, or its name")
    parser.add_argument(
        "captures",
        nargs="*",
        metavar="CAPTURE",
        help="a recording, hex as text, or raw bytes; - is standard input",
    )
    parser.add_argument(
        "--direction", metavar="SENDER", help="the endpoint that sent what names no sender"
    )
    parser.add_argument(
        "--input",
        choices=FORMS,
        default="auto",
        help="what the files hold, where it cannot be told",
    )
    parser.add_argument(
        "--tolerate",
        default="0",
        metavar="NOISE",
        help="so many bytes of noise are no finding, or so many per cent: 20, or 1%%",
    )
    parser.add_argument(
        "--format",
        choices=("text", "json", "markdown"),
        default="text",
        help="the format of the report",
    )
    parser.add_argument(
        "--evidence",
        action="store_true",
        help="print how many facts of the spec were seen on hardware, without a recording",
    )


def run(arguments: Namespace) -> int:
    """Print the report. 0 where all fits, 1 where something does not. Raises Unusable."""
    from framegen.audit.audit import audit  # noqa: PLC0415
    from framegen.audit.plain import as_json  # noqa: PLC0415
    from framegen.audit.text import as_markdown, as_text  # noqa: PLC0415
    from framegen.commands.capture_argument import directions_from  # noqa: PLC0415
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415

    model = compiled(arguments.spec).model
    if arguments.evidence:
        return _evidence(model, arguments)
    ways = directions_from(model, arguments.direction)
    recordings = _recordings(model, arguments)
    tolerated = _tolerated(arguments.tolerate, sum(each.size for each in recordings))
    found = audit(model, recordings, ways, tolerated)
    if arguments.format == "json":
        print(json.dumps(as_json(found)))
    else:
        for line in (as_text if arguments.format == "text" else as_markdown)(found):
            print(line)
    return 0 if found.fits else 1


def _evidence(model: Model, arguments: Namespace) -> int:
    from framegen.audit.evidence import evidence  # noqa: PLC0415
    from framegen.audit.plain import evidence_json  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    if arguments.captures:
        raise Unusable(
            "--evidence looks at no recording", hint="leave it out, and the report says it besides"
        )
    known = evidence(model)
    print(json.dumps(evidence_json(known)) if arguments.format == "json" else known)
    return 0


def _recordings(model: Model, arguments: Namespace) -> list[Recording]:
    """Read every file. Raises Unusable for one that cannot be read, or holds nothing."""
    from framegen.audit.recording import read_recording  # noqa: PLC0415
    from framegen.commands.capture_argument import content  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    hint = "record the line, as with `busservo monitor --log line.hex`"
    if not arguments.captures:
        raise Unusable("there is no recording to look at", hint=hint)
    if arguments.captures.count("-") > 1:
        raise Unusable("standard input can be read once", hint="name `-` once")
    ends = [*model.spec.endpoints]
    found: list[Recording] = []
    for file in arguments.captures:
        name = "standard input" if file == "-" else visible(file)
        recording = read_recording(name, content(file), ends, model.roles, arguments.input)
        if not recording.size:
            raise Unusable(f"{name} holds no bytes of a line", hint=hint)
        found.append(recording)
    return found


def _tolerated(text: str, size: int) -> int:
    """Return how many bytes of noise are no finding. Raises Unusable."""
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    found = _TOLERATED.fullmatch(text)
    if found is None:
        raise Unusable(
            f"--tolerate: {text!r} is no amount of noise",
            hint="write a number of bytes, or per cent: --tolerate 20, --tolerate 1%",
        )
    return int(found[1]) if found[1] else int(float(found[2]) * size / 100)
