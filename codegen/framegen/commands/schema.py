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
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare no arguments: the verb has none."""


def run(_arguments: Namespace) -> int:
    """Print the schema."""
    from framegen.targets.schema import schema_text  # noqa: PLC0415

    sys.stdout.write(schema_text())
    return 0
