"""The verbs that can run here: all of them, except those that need a package of their own."""

from __future__ import annotations

import sys
from importlib import import_module

from .examples import METHODS, POSE_METHODS, PROGRAM, VERBS

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

SIMULATOR = f"{PROGRAM}_simulator"


def verbs() -> dict[str, str]:
    """Return the summary of each verb, by name; `simulate` only if there is a simulator."""
    return {name: about for name, about in VERBS.items() if name != "simulate" or _is_installed()}


def verb_named(name: str) -> Any:
    """Return a verb: a module with its arguments and what it does, or what sends a message."""
    if name in METHODS:
        return import_module(".method_verb", __package__).MethodVerb(METHODS[name])
    if name in POSE_METHODS:
        return import_module(".pose_verb", __package__).PoseVerb(POSE_METHODS[name])
    return import_module(f".{name.replace('-', '_')}", __package__)


def _is_installed() -> bool:
    """Return whether the simulator would be found; it is not imported."""
    # As importlib.util.find_spec does, which in some versions of Python imports threading first.
    finders = [finder for finder in sys.meta_path if hasattr(finder, "find_spec")]
    return any(finder.find_spec(SIMULATOR, None) is not None for finder in finders)
