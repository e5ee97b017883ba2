"""`framegen diff`: compares two versions of a spec and classifies each change by what it breaks."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from framegen.comparison.kinds import Difference

SUMMARY = "Compare two versions of a spec, and classify each change by what it breaks."
EXAMPLES = (
    ("framegen diff old.yaml", "from old.yaml to spec/NAME.yaml of its protocol, here or above"),
    ("framegen diff old.yaml new.yaml", "from one to the other; 1 if anything breaks"),
    ("framegen diff old.yaml --json", "one difference a line, for programs"),
    ("git show v1.0.0:spec/name.yaml > old.yaml", "how to get at an old edition"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("old", type=Path, metavar="OLD", help="a spec file")
    parser.add_argument("new", nargs="?", type=Path, metavar="NEW", help="a later version of it")
    parser.add_argument("--json", action="store_true", help="print each as a line of JSON")


def run(arguments: Namespace) -> int:
    """Print the differences, the most serious first. 1 where the wire or programs break."""
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.comparison.kinds import differences  # noqa: PLC0415
    from framegen.project import named_spec  # noqa: PLC0415

    old = compiled(arguments.old)
    # Of several specs of a project, the one of this protocol.
    new = compiled(arguments.new or named_spec(old.spec.protocol.name))
    found = differences(old.model, new.model)
    order = ["wire", "programs", "nothing"]
    found.sort(key=lambda difference: order.index(difference.breaks))
    for difference in found:
        print(_json(difference) if arguments.json else _text(difference))
    sys.stdout.flush()
    print(_summary(found), file=sys.stderr)
    return 1 if any(difference.breaks != "nothing" for difference in found) else 0


def _text(difference: Difference) -> str:
    return f"{difference.breaks:8}  {difference.path}: {difference.kind}: {difference}"


def _json(difference: Difference) -> str:
    return json.dumps(
        {
            "breaks": difference.breaks,
            "kind": difference.kind,
            "path": difference.path,
            "old": difference.old,
            "new": difference.new,
        }
    )


def _summary(found: list[Difference]) -> str:
    if not found:
        return "nothing changed that a spec says"
    counts = [
        f"{sum(difference.breaks == what for difference in found)} {words}"
        for what, words in (("wire", "break the wire"), ("programs", "break programs"))
    ]
    return f"{pluralize(len(found), 'difference')}: {', '.join(counts)}"
