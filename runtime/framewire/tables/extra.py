"""What some parts need beside a library, and what to do where it is missing."""

from __future__ import annotations

from importlib import import_module


def are_there(*names: str, library: str, extra: str = "tables") -> bool:
    """Import what an extra of a library brings. Raises ImportError, which says how to get it."""
    for name in names:
        try:
            import_module(name)
        except ImportError as error:
            # That it is missing says all; what is broken in one that is there has a cause.
            cause = None if isinstance(error, ModuleNotFoundError) else error
            raise ImportError(
                f"{name} is needed here, and cannot be imported ({error}): "
                f"pip install '{library}[{extra}]'",
                name=name,
            ) from cause
    return True
