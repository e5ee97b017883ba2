"""The SPEC argument: finds the file and compiles it."""

from __future__ import annotations

import sys
from dataclasses import replace
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.compile import compile_spec, placed
from framegen.language.load import read_source
from framegen.project import carries_runtime, default_spec, named_spec
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from framegen.compile import Compiled


def spec_file(word: Path) -> Path:
    """Return the file that is meant: by its path, or by the name of a spec of the project."""
    return word if word.exists() else named_spec(str(word)) or word


def compiled(file: Path | None) -> Compiled:
    """Compile `file`, the named spec of the project, or the only spec.

    Its library has the runtime from where the project says that it is.
    Raises Unusable, with the place in the text, where it is no spec at all.
    """
    found = default_spec() if file is None else spec_file(file)
    source = read_source(found)
    try:
        return replace(compile_spec(source), carries_runtime=carries_runtime(found))
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
