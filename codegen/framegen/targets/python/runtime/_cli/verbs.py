"""The verbs that can run here: all of them, but for one that needs a package of its own."""

from __future__ import annotations

import sys

from .examples import PROGRAM, VERBS

SIMULATOR = f"{PROGRAM}_simulator"


def verbs() -> dict[str, str]:
    """What each is for, by name; `simulate` only where there is a simulator."""
    return {name: about for name, about in VERBS.items() if name != "simulate" or _is_installed()}


def _is_installed() -> bool:
    """Whether the simulator would be found; it is not imported."""
    # As importlib.util.find_spec does, which in some editions of Python imports threading first.
    finders = [finder for finder in sys.meta_path if hasattr(finder, "find_spec")]
    return any(finder.find_spec(SIMULATOR, None) is not None for finder in finders)
