"""The modules of a library, imported when they are first asked for."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import Any


def part_of(package: str, name: str) -> Any:
    """Return the module of this name in a package."""
    # Not importlib, which would have to be imported first.
    return __import__(f"{package}.{name}", fromlist=[name])
