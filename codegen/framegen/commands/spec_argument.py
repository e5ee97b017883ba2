"""The SPEC that verbs are given: which file it is, and what it says."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.project import default_spec
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from pathlib import Path

    from framegen.compile import Compiled


def compiled(file: Path | None) -> Compiled:
    """Compile `file`, or else the only spec of the project.

    Raises Unusable, with the place in its text, where it is no spec at all.
    """
    source = read_source(default_spec() if file is None else file)
    try:
        return compile_spec(source)
    except Unusable as error:
        place = "" if error.finding is None else f"\n{error.finding.render(source)}"
        raise Unusable(f"{source.name}: {error}{place}", hint=error.hint) from None
