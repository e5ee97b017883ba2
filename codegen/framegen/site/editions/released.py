"""The released editions of a protocol, read for its site."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.comparison.listing import edition_of, released
from framegen.language.load import read_source
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from pathlib import Path

    from framegen.comparison.edition import Edition

_KEPT = "a released edition stays as it was: take it from the history of the project again"


def read_released(spec: Path, name: str) -> list[Edition]:
    """Read the released editions of a protocol, the newest first; its spec is `spec`.

    Raises Unusable for one that cannot be read, or is not what its name says.
    """
    return [_read(file) for file in released(spec.parent, name)]


def _read(file: Path) -> Edition:
    source = read_source(file)
    edition = edition_of(source)
    said = f"{edition.spec.protocol.name}-{edition.version}"
    if said != file.stem:
        raise Unusable(
            f"{source.name} says that it is {visible(said)}, and its name is {visible(file.stem)}",
            hint=_KEPT,
        )
    return edition
