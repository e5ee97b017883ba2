"""`framegen missing`: what a change of a spec leaves to be written by hand."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Sequence

    from framegen.compile import Compiled
    from framegen.witnesses import Missing, Witness

SUMMARY = "Report what a change of a spec leaves to be written by hand, what to write, and where."
EXAMPLES = (
    ("framegen missing", "what tests/witnesses.yaml asks for of spec/*.yaml; 1 if any is missing"),
    ("framegen missing spec/busservo.yaml", "of this spec"),
    ("framegen missing --json", "one a line, for programs"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("specs", nargs="*", type=Path, metavar="SPEC", help="a spec file")
    parser.add_argument("--json", action="store_true", help="print each as a line of JSON")


def run(arguments: Namespace) -> int:
    """Print what is missing; to the error stream, what was looked at.

    1 where anything is missing, 2 where nothing says what there should be. Raises Unusable.
    """
    from framewire.command.console import UNUSABLE  # noqa: PLC0415

    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.project import all_specs, named_spec, project_root  # noqa: PLC0415
    from framegen.witnesses import find_missing, read_witnesses  # noqa: PLC0415

    statuses = [0]
    for given in arguments.specs or all_specs():
        file = given if given.exists() else named_spec(str(given)) or given
        spec, root = compiled(file), project_root(file)
        witnesses = read_witnesses(root, spec.spec.protocol.name)
        if witnesses is None:
            _complain(spec)
            statuses.append(UNUSABLE)
            continue
        found = find_missing(spec.model, witnesses, root)
        for each in found:
            print(_json(spec, each) if arguments.json else _text(spec, each))
        sys.stdout.flush()
        print(_summary(spec, witnesses, found), file=sys.stderr)
        statuses.append(1 if found else 0)
    return max(statuses)


def _text(spec: Compiled, missing: Missing) -> str:
    witness, subject = missing.witness, missing.subject
    at = spec.tree.key_at(subject.path)
    return (
        f"{witness.file}: {subject.name} has no {witness.kind}\n"
        f"    = see: {spec.source.name}:{at.line}:{at.column}\n"
        f"    = write: {witness.to_write(subject)}\n"
        f"    = why: {witness.why}\n"
    )


def _json(spec: Compiled, missing: Missing) -> str:
    from framegen.reading.yamltree import dotted  # noqa: PLC0415

    witness, subject = missing.witness, missing.subject
    at = spec.tree.key_at(subject.path)
    return json.dumps(
        {
            "kind": witness.kind,
            "in": witness.file,
            "file": spec.source.name,
            "line": at.line,
            "column": at.column,
            "path": dotted(subject.path),
            "write": witness.to_write(subject),
            "why": witness.why,
        }
    )


_ONE = {
    "messages": "message",
    "requests": "request",
    "queries": "query",
    "fields": "field",
    "values": "value",
    "bits": "bit",
    "addresses": "address",
}


def _summary(spec: Compiled, witnesses: Sequence[Witness], found: Sequence[Missing]) -> str:
    looked = {each.of: len([*each.subjects(spec.model)]) for each in witnesses}
    what = ", ".join(pluralize(number, _ONE[of], of) for of, number in looked.items())
    files = pluralize(len({each.file for each in witnesses}), "file")
    result = f"{len(found)} missing" if found else "nothing is missing"
    return f"{spec.source.name}: {what or 'nothing'} looked up in {files}: {result}"


def _complain(spec: Compiled) -> None:
    from framegen.witnesses import HOW_TO_DECLARE  # noqa: PLC0415

    name, messages = spec.spec.protocol.name, pluralize(len(spec.model.messages), "message")
    print(
        f"framegen: error: {spec.source.name} has {messages}, and no witness is declared for it: "
        f"nothing was looked for\n"
        f"  hint: {HOW_TO_DECLARE.replace('NAME', name)}",
        file=sys.stderr,
    )
