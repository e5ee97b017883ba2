"""`framegen check`: every finding about a spec."""

from __future__ import annotations

import json
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from framegen.compile import Compiled
    from framegen.reading.findings import Finding
    from framegen.targets.target import BentName

# Of one rule.
_MOST_REMARKS = 3
SUMMARY = "Check a spec against all rules, its examples and errata included."
EXAMPLES = (
    ("framegen check", "every spec/*.yaml, here or in a folder above"),
    ("framegen check spec/busservo.yaml", "this spec"),
    ("framegen check --json", "one finding or remark a line, for programs"),
    ("framegen rules unknown-type", "why a rule exists, and how to keep it"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("specs", nargs="*", type=Path, metavar="SPEC", help="a spec file")
    parser.add_argument("--json", action="store_true", help="print each finding as a line of JSON")


def run(arguments: Namespace) -> int:
    """Print the findings; counts and remarks go to the error stream. Return 1 for any finding.

    The error stream also names what a target writes otherwise, so that lines of the output are
    findings; as JSON, remarks are lines of the output, too.
    """
    from framegen.checks import remarks  # noqa: PLC0415
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.project import all_specs  # noqa: PLC0415

    specs = [compiled(file) for file in arguments.specs or all_specs()]
    for each in specs:
        for finding in each.findings:
            print(_json(each, finding, "error") if arguments.json else _text(each, finding))
        found = [] if each.findings else remarks(each.model, each.tree)
        for remark in found if arguments.json else ():
            print(_json(each, remark, "note"))
        sys.stdout.flush()
        for note in (*_notes(each), *(() if arguments.json else _shown(each, found))):
            print(note, file=sys.stderr)
        print(_summary(each), file=sys.stderr)
    return 1 if any(each.findings for each in specs) else 0


def _text(each: Compiled, finding: Finding) -> str:
    return finding.render(each.source) + "\n"


def _json(each: Compiled, finding: Finding, severity: str) -> str:
    return json.dumps(
        {
            "severity": severity,
            "rule": finding.rule,
            "file": each.source.name,
            "line": finding.span.line,
            "column": finding.span.column,
            "path": finding.path,
            "message": finding.message,
            "hint": finding.hint,
        }
    )


def _shown(each: Compiled, found: list[Finding]) -> Iterator[str]:
    """Show the remarks, those of one rule up to a number."""
    times = Counter(remark.rule for remark in found)
    shown: Counter[str] = Counter()
    for remark in found:
        shown[remark.rule] += 1
        if shown[remark.rule] > _MOST_REMARKS:
            continue
        place = f"{each.source.name}:{remark.span.line}:{remark.span.column}"
        yield f"{place}: note: {remark.rule}: {remark.message}"
        if remark.hint:
            yield f"  = hint: {remark.hint}"
        more = times[remark.rule] - _MOST_REMARKS
        if shown[remark.rule] == _MOST_REMARKS and more > 0:
            yield f"  = and {more} more of `{remark.rule}`: `framegen check --json` lists them all"


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
