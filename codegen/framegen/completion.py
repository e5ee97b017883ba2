"""What a shell needs to complete `framegen`: its verbs, their options, specs, rules and targets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.command.shell_completion import Files, Folders, Words, script

if TYPE_CHECKING:
    from argparse import Action, ArgumentParser

    from framewire.command.shell_completion import Candidates

_SPEC = Files(".yaml", ".yml")
# What stands for an argument, by the word that help has for it.
_BY_METAVAR: dict[str, Candidates] = {
    "FILE": Files(),
    "FOLDER": Folders(),
    # Bytes may be behind the name of a spec.
    "HEX": _SPEC,
    "NEW": _SPEC,
    "OLD": _SPEC,
    "PORT": Files(),
    "SPEC": _SPEC,
}


def completion(parser: ArgumentParser, shell: str) -> str:
    """Return the script for a shell. Raises CompletionError where none can be made.

    `parser` is that of the command, with all verbs as its subparsers.
    """
    return script(parser, shell, _candidates)


def _candidates(command: str, action: Action) -> Candidates | None:
    from framegen.checks import RULES  # noqa: PLC0415
    from framegen.comparison.changes import CHANGE_RULES  # noqa: PLC0415
    from framegen.targets.table import TARGETS  # noqa: PLC0415

    if command == "framegen rules" and action.metavar == "ID":
        return Words([rule.id for rule in (*RULES, *CHANGE_RULES)])
    is_target = command == "framegen targets" and action.metavar == "NAME"
    if is_target or action.dest in {"target", "targets"}:
        return Words([target.name for target in TARGETS])
    return _BY_METAVAR.get(str(action.metavar))
