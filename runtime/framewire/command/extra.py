"""Parts of the command that need an extra of its package, imported when they are asked for."""

from __future__ import annotations

from importlib import import_module

from ..tables.extra import are_there
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

# What each of them brings, as far as it is imported here.
_BROUGHT = {"tables": ("numpy", "pyarrow"), "plots": ("matplotlib",)}


def imported(name: str, package: str, *extras: str) -> Any:
    """Import a module of this folder. Raises UsageError where an extra of `package` is missing."""
    try:
        for extra in extras:
            are_there(*_BROUGHT[extra], library=package, extra=extra)
        return import_module(f".{name}", __package__)
    except ImportError as error:
        raise UsageError(str(error)) from None
