"""The SPEC that verbs are given: which file it is, and what is read from it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks import check
from framegen.language.load import load, read_source
from framegen.model.layout import derive
from framegen.project import default_spec
from framegen.reading.yamltree import Unusable
from framegen.wording import counted

if TYPE_CHECKING:
    from pathlib import Path

    from framegen.language.load import Loaded
    from framegen.model.layout import Layout


def read_spec(file: Path | None) -> Loaded:
    """Read `file`, or else the spec of the project. Raises Unusable, with the place in its text."""
    source = read_source(default_spec() if file is None else file)
    try:
        return load(source)
    except Unusable as error:
        place = "" if error.finding is None else f"\n{error.finding.render(source)}"
        raise Unusable(f"{source.name}: {error}{place}", hint=error.hint) from None


def read_layout(file: Path | None) -> Layout:
    """Read a spec and derive its layout. Raises Unusable where the spec has findings."""
    loaded = read_spec(file)
    findings = check(loaded)
    if findings or loaded.spec is None:
        name, first = loaded.source.name, findings[0].render(loaded.source)
        raise Unusable(
            f"{name} has {counted(len(findings), 'finding')}; the first is\n{first}",
            hint=f"`framegen check {name}` shows them all",
        )
    return derive(loaded.spec)
