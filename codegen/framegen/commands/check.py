"""`framegen check`: every finding about a spec."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from framegen.compile import Compiled
    from framegen.reading.findings import Finding
    from framegen.targets.target import BentName

SUMMARY = "Check a spec against all rules, its examples and errata included."
EXAMPLES = (
    ("framegen check", "every spec/*.yaml, here or in a folder above"),
    ("framegen check spec/busservo.yaml", "this spec"),
    ("framegen check --json", "one finding a line, for programs"),
    ("framegen rules unknown-type", "why a rule exists, and how to keep it"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("specs", nargs="*", type=Path, metavar="SPEC", help="a spec file")
    parser.add_argument("--json", action="store_true", help="print each finding as a line of JSON")


def run(arguments: Namespace) -> int:
    """Print the findings; counts and remarks go to the error stream. Return 1 if there are any.

    The error stream also names what a target writes otherwise, so that lines of the output are
    findings.
    """
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.project import all_specs  # noqa: PLC0415

    specs = [compiled(file) for file in arguments.specs or all_specs()]
    for each in specs:
        for finding in each.findings:
            print(_json(each, finding) if arguments.json else _text(each, finding))
        sys.stdout.flush()
        for note in _notes(each):
            print(note, file=sys.stderr)
        print(_summary(each), file=sys.stderr)
    return 1 if any(each.findings for each in specs) else 0


def _text(each: Compiled, finding: Finding) -> str:
    return finding.render(each.source) + "\n"


def _json(each: Compiled, finding: Finding) -> str:
    return json.dumps(
        {
            "rule": finding.rule,
            "file": each.source.name,
            "line": finding.span.line,
            "column": finding.span.column,
            "path": finding.path,
            "message": finding.message,
            "hint": finding.hint,
        }
    )


def _notes(each: Compiled) -> Iterator[str]:
    """Name each name that a target writes otherwise, once, where it first occurs."""
    from framegen.targets.table import TARGETS  # noqa: PLC0415

    if each.findings:
        return
    for target in TARGETS:
        places: dict[tuple[str, str], list[BentName]] = {}
        for found in target.bent(each.model):
            places.setdefault((found.name, found.bent), []).append(found)
        for (name, bent), found_there in places.items():
            first, *others = found_there
            at = each.tree.key_at(first.path)
            also = f" (and so in {pluralize(len(others), 'place')} more)" if others else ""
            yield (
                f"{each.source.name}:{at.line}:{at.column}: note: {target.name} writes the "
                f"{first.kind} `{name}` as `{bent}`{also}: it {first.why}"
            )


def _summary(each: Compiled) -> str:
    name, spec, findings = each.source.name, each.read, each.findings
    if spec is None:
        found = f"{pluralize(len(findings), 'finding')} in {name}"
        return f"{found}; check again once its shape is mended, for what it says was not looked at"
    if findings:
        return f"{pluralize(len(findings), 'finding')} in {name}"
    examples = sum(len(message.examples) for message in spec.messages.values())
    return (
        f"{name}: {pluralize(len(spec.messages), 'message')}, {pluralize(examples, 'example')}, "
        f"{pluralize(len(spec.errata), 'erratum', 'errata')} checked: nothing found"
    )
