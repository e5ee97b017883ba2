"""What a shell needs to complete a command line, made by shtab, which is an extra."""

from __future__ import annotations

import re
from importlib import import_module

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Action, ArgumentParser
    from collections.abc import Callable, Collection, Iterator
    from typing import Any, TypeAlias

SHELLS = ("bash", "zsh", "tcsh", "fish")


class CompletionError(Exception):
    """There is no completion, for the reason that its text gives."""


class Words:
    """Candidates that are known beforehand."""

    def __init__(self, words: Collection[str]) -> None:
        self.words = words


class Files:
    """Files as candidates, and the folders that lead to them: those that end so, or all."""

    def __init__(self, *endings: str) -> None:
        self.endings = endings


class Folders:
    """Folders as candidates."""


class Function:
    """Candidates that a function of the shell finds, by its name and its text in each shell.

    In bash it prints what begins with its first argument, in zsh it calls compadd, and in fish it
    prints all that there are; tcsh has no functions.
    """

    def __init__(self, name: str, texts: dict[str, str]) -> None:
        self.name = name
        self.texts = texts


if TYPE_CHECKING:
    Candidates: TypeAlias = Words | Files | Folders | Function
    # What stands for an argument of a command, whose name comes first.
    Finder: TypeAlias = Callable[[str, Action], Candidates | None]


def add_option(parser: ArgumentParser) -> None:
    """Declare --print-completion."""
    parser.add_argument(
        "--print-completion",
        choices=SHELLS,
        metavar="SHELL",
        help=f"print what a shell needs to complete this command ({', '.join(SHELLS)})",
    )


def script(parser: ArgumentParser, shell: str, find: Finder) -> str:
    """Return the script for a shell. Raises CompletionError where shtab is missing or too old.

    What is to be completed, verbs included, is declared in `parser`; `find` gives the candidates of
    each argument that has no choices.
    """
    try:
        shtab = import_module("shtab")
    except ModuleNotFoundError:
        raise CompletionError(
            "completion is made by shtab, which is not installed here: pip install shtab"
        ) from None
    try:
        for command, action in _arguments(parser):
            found = find(command, action)
            if isinstance(found, Words):
                action.choices = [*found.words]
            elif found is not None:
                vars(action)["complete"] = _completer(shtab, found)
        made: str = shtab.complete(parser, shell=shell)
    except (AttributeError, NotImplementedError):
        raise CompletionError(
            f"this shtab is too old to know {shell}: pip install --upgrade shtab"
        ) from None
    if shell == "bash":
        made += _WITHOUT_BLANK.format(program=parser.prog, word=re.sub(r"\W", "_", parser.prog))
    return made


# bash puts a blank behind what it completes, unless it is told otherwise.
_WITHOUT_BLANK = """

_complete_{word}() {{
  _shtab_{word} "$@"
  if [[ ${{COMPREPLY[0]-}} == *= ]]; then compopt -o nospace 2>/dev/null || :; fi
}}

complete -o bashdefault -F _complete_{word} {program}"""


def _arguments(parser: ArgumentParser) -> Iterator[tuple[str, Action]]:
    """Every argument of a command and its verbs, with the command that it is of."""
    # argparse shows nobody a list of them.
    for action in vars(parser)["_actions"]:
        if isinstance(action.choices, dict):
            for verb in action.choices.values():
                yield from _arguments(verb)
        elif action.choices is None:
            yield parser.prog, action


def _completer(shtab: Any, found: Files | Folders | Function) -> object:
    """Return what shtab takes for it."""
    if isinstance(found, Folders):
        return shtab.DIRECTORY
    if isinstance(found, Files):
        return shtab.glob(*(f"*{each}" for each in found.endings)) if found.endings else shtab.FILE
    calls = {"bash": found.name, "zsh": found.name, "fish": f"({found.name})"}
    return calls | {"preamble": found.texts}
