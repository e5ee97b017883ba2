"""The verbs of a command, each with what runs it."""

from __future__ import annotations

from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from .program import Program


def verb_named(name: str, program: Program) -> Any:
    """Return a verb: a module with its arguments and what it does, or what sends a message."""
    if name in program.methods:
        made = import_module(".method_verb", __package__)
        return made.MethodVerb(program.methods[name], program.library)
    if name in program.pose_methods:
        made = import_module(".pose_verb", __package__)
        return made.PoseVerb(program.pose_methods[name], program.library)
    return import_module(f".{name.replace('-', '_')}", __package__)
