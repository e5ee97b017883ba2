"""`framegen rules`: lists the rules of `framegen check`, with their reasons."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from framegen.checks.rule import AnyRule

SUMMARY = "List the rules that a spec must keep, or explain one of them."
EXAMPLES = (
    ("framegen rules", "every rule in a line"),
    ("framegen rules unknown-type", "why it exists, what breaks it and what keeps it"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("id", nargs="?", metavar="ID", help="a rule, as findings name it")


def run(arguments: Namespace) -> int:
    """Print the rules, or one of them. Raises Unusable for an unknown rule."""
    from framegen.checks import RULES  # noqa: PLC0415
    from framegen.reading.findings import did_you_mean  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    rules = {rule.id: rule for rule in RULES}
    if arguments.id is None:
        width = max(map(len, rules))
        for rule in rules.values():
            print(f"{rule.id:<{width}}  {rule.title}")
        return 0
    if arguments.id not in rules:
        hint = did_you_mean(arguments.id, rules, otherwise="`framegen rules` lists them")
        raise Unusable(f"there is no rule {arguments.id!r}", hint=hint)
    print("\n".join(_described(rules[arguments.id])))
    return 0


def _described(rule: AnyRule) -> Iterator[str]:
    yield f"{rule.id}: {rule.title}"
    yield ""
    yield from rule.why.splitlines()
    for verdict, example in (("refused", rule.bad), ("accepted", rule.good)):
        yield ""
        yield f"{verdict}:"
        yield from (f"  {line}".rstrip() for line in example.splitlines())
