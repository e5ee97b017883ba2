"""The SPEC argument: finds the file and compiles it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from framegen.compile import compile_spec, placed
from framegen.language.load import read_source
from framegen.pluralize import pluralize
from framegen.project import default_spec, named_spec
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from framegen.compile import Compiled


def compiled(file: Path | None) -> Compiled:
    """Compile `file`, the named spec of the project, or the only spec.

    Raises Unusable, with the place in the text, where it is no spec at all.
    """
    if file is None:
        file = default_spec()
    elif not file.exists():
        file = named_spec(str(file)) or file
    source = read_source(file)
    try:
        return compile_spec(source)
    except Unusable as error:
        raise placed(error, source) from None


def print_findings(specs: Sequence[Compiled]) -> bool:
    """Print the findings of specs that something was to be written of; return whether any is."""
    for spec in specs:
        for finding in spec.findings:
            print(finding.render(spec.source) + "\n")
        if spec.findings:
            sys.stdout.flush()
            found = pluralize(len(spec.findings), "finding")
            print(f"{found} in {spec.source.name}: nothing was written", file=sys.stderr)
    return any(spec.findings for spec in specs)
