"""`framegen schema`: prints the JSON Schema of the spec language, for editors."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

SUMMARY = "Print the JSON Schema of the spec language, for completion and help in an editor."
EXAMPLES = (
    ("framegen schema", "the whole language, each key with its description"),
    ("framegen schema > spec/framegen.schema.json", "where the first line of a spec points"),
    ("framegen schema --site > docs/site.schema.json", "the same for the keys of docs/site.yaml"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "--site", action="store_true", help="the schema of docs/site.yaml, which is no spec"
    )


def run(arguments: Namespace) -> int:
    """Print the schema."""
    from framegen.targets.schema import schema_text, site_schema_text  # noqa: PLC0415

    sys.stdout.write(site_schema_text() if arguments.site else schema_text())
    return 0
