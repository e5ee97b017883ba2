"""The runtime that a library carries: what all libraries share, as it is, in a folder of it."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import framewire

if TYPE_CHECKING:
    from collections.abc import Mapping

FOLDER = "_runtime"
_SHARED = Path(framewire.__file__).parent
_BROUGHT = ("*.py", "*.typed", "LICENSE")


@cache
def carried_runtime() -> Mapping[str, str]:
    """Return the files of the runtime, by path below the package of the library."""
    return {
        f"{FOLDER}/{file.relative_to(_SHARED).as_posix()}": file.read_text(encoding="utf-8")
        for pattern in _BROUGHT
        for file in sorted(_SHARED.rglob(pattern))
    }
