"""`framegen generate`: everything that follows from a spec, written, compared or shown."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.console import visible
from framegen.wording import counted

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

SUMMARY = "Write the library, the reference, the editor schema and the test vectors of a spec."
EXAMPLES = (
    ("framegen generate", "write what spec/*.yaml asks for; only what differs is touched"),
    ("framegen generate --diff", "show what that would change, and change nothing"),
    ("framegen generate --check", "fail if anything would change: for CI"),
    ("framegen generate --out build", "write below another folder"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("spec", nargs="?", type=Path, metavar="SPEC", help="a spec file")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--check", action="store_true", help="write nothing; 1 if anything differs")
    how.add_argument("--diff", action="store_true", help="write nothing; show what would change")
    parser.add_argument(
        "--out", type=Path, metavar="FOLDER", help="write below this folder, not the spec's project"
    )


def run(arguments: Namespace) -> int:
    """Check the spec, render it, and bring the disk to agree. 1 for findings, or with --check."""
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.project import default_spec, project_root  # noqa: PLC0415
    from framegen.render import render  # noqa: PLC0415
    from framegen.writer import changes, write  # noqa: PLC0415

    file: Path = arguments.spec or default_spec()
    spec = compiled(file)
    if spec.findings:
        for finding in spec.findings:
            print(finding.render(spec.source) + "\n")
        found = counted(len(spec.findings), "finding")
        _tell(f"{found} in {spec.source.name}: nothing was written")
        return 1
    root: Path = arguments.out or project_root(file)
    rendered = render(spec)
    files = counted(len(rendered.files), "file")
    if not (arguments.check or arguments.diff):
        done = write(root, rendered)
        for change in done:
            print(f"{'removed' if change.new is None else 'wrote'} {visible(change.path)}")
        _tell(f"{files} from {spec.source.name}: {len(done) or 'none'} changed")
        return 0
    differing = changes(root, rendered)
    for change in differing:
        print(change.diff(), end="")
    sys.stdout.flush()
    for change in differing:
        _tell(f"{change.why}: {visible(change.path)}")
    _tell(f"{files} from {spec.source.name}: {len(differing) or 'none'} would change")
    return 1 if differing and arguments.check else 0


def _tell(text: str) -> None:
    sys.stdout.flush()
    print(text, file=sys.stderr)
