"""`framegen targets`: lists the targets, and the names that each of them reserves."""

from __future__ import annotations

from textwrap import wrap
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from framegen.model.model import Model
    from framegen.targets.target import Target

SUMMARY = "List the targets, or the reserved words of one of them and what they become."
EXAMPLES = (
    ("framegen targets", "every target, with its folders"),
    ("framegen targets python", "the words that it has taken, and what a name becomes that is one"),
)
_WIDTH = 100


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("name", nargs="?", metavar="NAME", help="a target")


def run(arguments: Namespace) -> int:
    """Print the targets, or one of them. Raises Unusable for an unknown target."""
    from framegen.reading.findings import did_you_mean  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415
    from framegen.targets.table import TARGETS  # noqa: PLC0415

    targets = {target.name: target for target in TARGETS}
    if arguments.name is None:
        print("\n".join(_overview(list(targets.values()), _models())))
        return 0
    if arguments.name not in targets:
        hint = did_you_mean(arguments.name, targets, otherwise="`framegen targets` lists them")
        raise Unusable(f"there is no target {arguments.name!r}", hint=hint)
    print("\n".join(_described(targets[arguments.name])))
    return 0


def _models() -> list[Model]:
    """Return the models of the specs at hand; none where one has findings."""
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.project import all_specs  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    try:
        return [compiled(file).model for file in all_specs()]
    except Unusable:
        return []


def _overview(targets: list[Target], models: list[Model]) -> Iterator[str]:
    width = max(len(target.name) for target in targets)
    for target in targets:
        yield f"{target.name:<{width}}  {target.about}"
        folders = dict.fromkeys(folder for model in models for folder in target.folders(model))
        taken = {word for row in target.reserved for word in row.words}
        if folders:
            yield f"{'':<{width}}  all of {', '.join(f'{folder}/' for folder in folders)}"
        if taken:
            yield f"{'':<{width}}  {pluralize(len(taken), 'reserved word')}"


def _described(target: Target) -> Iterator[str]:
    yield f"{target.name}: {target.about}"
    if not target.reserved:
        yield ""
        yield "No word is reserved: every name stays as it is."
    for row in target.reserved:
        yield ""
        yield f"{row.kind}: NAME becomes NAME{row.suffix} where it {row.why}"
        yield from wrap(
            " ".join(sorted(row.words)), _WIDTH, initial_indent="  ", subsequent_indent="  "
        )
