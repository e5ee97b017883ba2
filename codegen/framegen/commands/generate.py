"""`framegen generate`: writes, compares or shows everything that follows from the specs."""

from __future__ import annotations

import os
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import table, visible
from framewire.frame.pluralize import pluralize

from framegen.commands.output_arguments import add_force, add_spec

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Sequence

    from framegen.compile import Compiled
    from framegen.output import Output
    from framegen.writing import Survey, Written

SUMMARY = "Write the libraries, the reference, the test vectors and the editor schema of all specs."
EXAMPLES = (
    ("framegen generate", "write the files of spec/*.yaml; only those that differ are touched"),
    ("framegen generate spec/busservo.yaml", "what this spec asks for, and no other"),
    ("framegen generate --target python", "the libraries alone"),
    ("framegen generate --diff", "show what that would change, and change nothing"),
    ("framegen generate --check", "fail if anything would change: for CI"),
    ("framegen generate --out build", "write below another folder"),
    ("framegen generate --runtime carried --out build", "libraries there that need nothing else"),
)
_WRITES = (
    ("generated/NAME/", "the library of the spec with this `name`, and its test vectors"),
    ("generated/NAME.manifest", "by what framegen knows its own files from those of others"),
    ("docs/reference/NAME/", "the reference, in Markdown"),
    ("spec/framegen.schema.json", "the schema for editors, with spec/framegen.manifest beside it"),
)
ABOUT = f"""\
{table("what `framegen generate` writes", _WRITES)}

These paths are below the folder that holds spec/, or for a spec that lies elsewhere below its own
folder, or below --out. Only what framegen wrote is replaced or removed."""
CARRIED, SHARED = "carried", "shared"
# Of many files that are in nobody's way, as many are named.
_NAMED = 3


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    add_spec(parser)
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--check", action="store_true", help="write nothing; 1 if anything differs")
    how.add_argument("--diff", action="store_true", help="write nothing; show what would change")
    add_force(how)
    parser.add_argument(
        "--target",
        metavar="NAME",
        help="write the files of this target alone; without it, those of all targets, or of the "
        "`targets` that pyproject.toml has under [tool.framegen]",
    )
    parser.add_argument(
        "--out",
        type=Path,
        metavar="FOLDER",
        help="write below this folder; otherwise below the one that holds spec/, "
        "or that of a spec which lies elsewhere",
    )
    parser.add_argument(
        "--runtime",
        choices=(SHARED, CARRIED),
        help="whether libraries import what all of them have in common from the package framewire, "
        f"or each brings it; without this, {SHARED} where the project has runtime/framewire, and "
        f"{CARRIED} elsewhere",
    )


def run(arguments: Namespace) -> int:
    """Check the specs, render them, and update the disk. 1: findings, or changes with --check."""
    from framegen.chosen_targets import chosen_targets, named_target  # noqa: PLC0415
    from framegen.commands.spec_argument import compiled, print_findings  # noqa: PLC0415
    from framegen.project import FOLDER, all_specs, project_root  # noqa: PLC0415
    from framegen.render import render, render_shared  # noqa: PLC0415
    from framegen.writing import survey, write  # noqa: PLC0415

    files: list[Path] = [arguments.spec] if arguments.spec else all_specs()
    chosen = chosen_targets(project_root(files[0]))
    targets = [named_target(arguments.target, chosen)] if arguments.target else chosen
    specs = [compiled(file) for file in files]
    if arguments.runtime is not None:
        specs = [replace(spec, carries_runtime=arguments.runtime == CARRIED) for spec in specs]
    if print_findings(specs):
        return 1
    root: Path = arguments.out or project_root(files[0])
    outputs = [render(spec, targets, among=chosen) for spec in specs]
    shared_output = render_shared(specs[0], targets)
    # What is chosen no more takes its files along.
    if shared_output.files or (not arguments.target and (root / shared_output.manifest).exists()):
        outputs.append(shared_output)
    outputs = [output for output in outputs if output.files or not arguments.target]
    # A spec that is gone from the project takes along what came from it.
    all_of = None if arguments.spec or arguments.target else FOLDER
    shared = arguments.out is not None
    if arguments.check or arguments.diff:
        would = survey(root, outputs, all_of=all_of, shared=shared)
        _show(would)
        _sum_up(outputs, specs, root, f"{len(would.changes) or 'none'} would change")
        return 1 if would.changes and arguments.check else 0
    done = write(root, outputs, all_of=all_of, shared=shared, force=arguments.force)
    _report(done, _copies(specs))
    _sum_up(outputs, specs, root, f"{len(done.changes) or 'none'} changed")
    return 0


def _show(found: Survey) -> None:
    for change in found.changes:
        print(change.diff(), end="")
    for change in found.changes:
        _tell(f"{change.why}: {visible(change.path)}")
    _remark(found)


def _copies(specs: Sequence[Compiled]) -> tuple[str, ...]:
    """Return the folders of what is brought as it is: nobody wants to hear of each file."""
    from framegen.targets.table import TARGETS  # noqa: PLC0415

    folders = {each for spec in specs for made in TARGETS for each in made.copies(spec.model)}
    return tuple(f"{folder}/" for folder in sorted(folders))


def _report(done: Written, copies: tuple[str, ...]) -> None:
    brought: Counter[tuple[str, str]] = Counter()
    for change in done.changes:
        what = "removed" if change.new is None else "wrote"
        if change.path in done.kept:
            print(f"kept {visible(change.path)} as {visible(done.kept[change.path])}")
        elif folder := next(filter(change.path.startswith, copies), ""):
            brought[what, folder] += 1
            continue
        if change.new is not None or change.path not in done.kept:
            print(f"{what} {visible(change.path)}")
    for (what, folder), number in brought.items():
        print(f"{what} {pluralize(number, 'file')} of {visible(folder)}")
    _remark(done)


def _remark(found: Survey | Written) -> None:
    """Print a remark on the output that calls for no action."""
    for notice in found.notices:
        _tell(visible(notice))
    for path in found.strangers[:_NAMED]:
        _tell(f"left alone, because framegen did not write it: {visible(path)}")
    if len(found.strangers) > _NAMED:
        _tell(f"left alone, too: {pluralize(len(found.strangers) - _NAMED, 'more file')}")


def _sum_up(outputs: Sequence[Output], specs: Sequence[Compiled], root: Path, what: str) -> None:
    from framegen.project import near  # noqa: PLC0415

    files = pluralize(sum(len(output.files) + 1 for output in outputs), "file")
    source = specs[0].source.name if len(specs) == 1 else pluralize(len(specs), "spec")
    # Paths are shown as they are below the root: so it is said where that is another folder.
    is_here = os.path.realpath(root) == os.path.realpath(Path())
    below = "" if is_here else f" below {visible(near(root).as_posix())}"
    _tell(f"{files} from {source}{below}: {what}")


def _tell(text: str) -> None:
    sys.stdout.flush()
    print(text, file=sys.stderr)
