"""`framegen rules`: lists the rules of `framegen check`, or of changes, with their reasons."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from framegen.checks.rule import AnyRule
    from framegen.comparison.changes.change import ChangeRule

SUMMARY = "List the rules that a spec must keep, or explain one of them."
EXAMPLES = (
    ("framegen rules", "every rule in a line"),
    ("framegen rules unknown-type", "why it exists, what breaks it and what keeps it"),
    ("framegen rules --changes", "every kind of change that `framegen diff` tells of"),
    ("framegen rules field-type", "what a change means, and what to do about it"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("id", nargs="?", metavar="ID", help="a rule, as findings name it")
    parser.add_argument(
        "--changes", action="store_true", help="the kinds of changes between two editions instead"
    )


def run(arguments: Namespace) -> int:
    """Print the rules, or one of them. Raises Unusable for an unknown rule."""
    from framegen.checks import RULES  # noqa: PLC0415
    from framegen.comparison.changes import CHANGE_RULES  # noqa: PLC0415
    from framegen.reading.findings import did_you_mean  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    rules = {rule.id: rule for rule in RULES}
    changes = {rule.id: rule for rule in CHANGE_RULES}
    if arguments.id is None:
        _list(changes if arguments.changes else rules)
        if not arguments.changes:
            # Beside the list, which other programs may read.
            print(
                f"`framegen rules --changes` lists the kinds of changes ({len(changes)})",
                file=sys.stderr,
            )
        return 0
    if arguments.id not in rules.keys() | changes.keys():
        known = changes if arguments.changes else rules | changes
        option = " --changes" if arguments.changes else ""
        hint = did_you_mean(arguments.id, known, otherwise=f"`framegen rules{option}` lists them")
        raise Unusable(f"there is no rule {arguments.id!r}", hint=hint)
    if arguments.id in rules:
        print("\n".join(_described(rules[arguments.id])))
    else:
        print("\n".join(_change(changes[arguments.id])))
    return 0


def _list(rules: dict[str, AnyRule] | dict[str, ChangeRule]) -> None:
    width = max(map(len, rules))
    for id_, rule in rules.items():
        print(f"{id_:<{width}}  {rule.title}")


def _described(rule: AnyRule) -> Iterator[str]:
    yield f"{rule.id}: {rule.title}"
    yield ""
    yield from rule.why.splitlines()
    for verdict, example in (("refused", rule.bad), ("accepted", rule.good)):
        yield ""
        yield f"{verdict}:"
        yield from (f"  {line}".rstrip() for line in example.splitlines())


def _change(rule: ChangeRule) -> Iterator[str]:
    yield f"{rule.id}: {rule.title}"
    yield ""
    yield f"{rule.why} {rule.do}"
    where = f", below {rule.at}" if rule.at else ""
    for edition, example in (("before", rule.before), ("after", rule.after)):
        yield ""
        yield f"{edition}{where}:"
        yield from (f"  {line}".rstrip() for line in (example or "(nothing)").splitlines())
