"""Parts of the command that need an extra of this package, imported when they are asked for."""

from __future__ import annotations

from importlib import import_module

from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


def imported(name: str, *, needs: str = "") -> Any:
    """Import a module of this folder. Raises UsageError where the extra that it needs is missing.

    `needs` is what it needs beside the extra `tables`: a package of the extra `plots`.
    """
    try:
        if needs:
            import_module(".._tables.extra", __package__).need(needs, extra="plots")
        return import_module(f".{name}", __package__)
    except ImportError as error:
        raise UsageError(str(error)) from None
