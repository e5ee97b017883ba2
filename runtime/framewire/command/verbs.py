"""The verbs that can run here: all of them, except those that need a package of their own."""

from __future__ import annotations

import sys
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from .program import Program


def verbs(program: Program) -> dict[str, str]:
    """Return the summary of each verb, by name; `simulate` only if there is a simulator."""
    there = program.verbs.items()
    return {name: about for name, about in there if name != "simulate" or _is_installed(program)}


def verb_named(name: str, program: Program) -> Any:
    """Return a verb: a module with its arguments and what it does, or what sends a message."""
    if name in program.methods:
        made = import_module(".method_verb", __package__)
        return made.MethodVerb(program.methods[name], program.library)
    if name in program.pose_methods:
        made = import_module(".pose_verb", __package__)
        return made.PoseVerb(program.pose_methods[name], program.library)
    return import_module(f".{name.replace('-', '_')}", __package__)


def _is_installed(program: Program) -> bool:
    """Return whether the simulator would be found; it is not imported."""
    # As importlib.util.find_spec does, which in some versions of Python imports threading first.
    finders = [finder for finder in sys.meta_path if hasattr(finder, "find_spec")]
    return any(finder.find_spec(program.simulator, None) is not None for finder in finders)
