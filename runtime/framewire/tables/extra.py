"""What some parts need beside the library, and what to do where it is missing."""

from __future__ import annotations

from importlib import import_module

_PACKAGE = __name__.partition(".")[0]


def need(*names: str, extra: str = "tables") -> None:
    """Import what an extra of this package brings. Raises ImportError, which says how to get it."""
    for name in names:
        try:
            import_module(name)
        except ImportError as error:
            # That it is missing says all; what is broken in one that is there has a cause.
            cause = None if isinstance(error, ModuleNotFoundError) else error
            raise ImportError(
                f"{name} is needed here, and cannot be imported ({error}): "
                f"pip install '{_PACKAGE}[{extra}]'",
                name=name,
            ) from cause
