"""Shell completion of the command line, made by shtab, an extra."""

from __future__ import annotations

from argparse import ArgumentParser
from importlib import import_module

from .._client.exchanges import EXCHANGES
from ..messages import MESSAGES
from .events import KINDS
from .examples import PROGRAM, SUMMARY
from .usage_error import UsageError
from .verbs import verbs

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Action
    from typing import Any

_FILES = {"FILE", "HEX|FILE", "PORT"}


def script(shell: str) -> str:
    """Return the script for a shell. Raises UsageError if shtab is missing or too old."""
    try:
        shtab = import_module("shtab")
    except ModuleNotFoundError:
        raise UsageError(
            "completion is made by shtab, which is not installed here: pip install shtab"
        ) from None
    # All verbs in one parser; the command itself imports only the one that is called.
    parser = _Parser(prog=PROGRAM, description=SUMMARY)
    parser.add_argument("--version", action="store_true", help="show the version")
    parts = parser.add_subparsers()
    for name, about in verbs().items():
        verb = import_module(f"{__package__}.{name.replace('-', '_')}")
        part = parts.add_parser(name, help=about)
        if hasattr(verb, "add_arguments"):
            verb.add_arguments(part)
    try:
        made: str = shtab.complete(parser, shell=shell)
    except NotImplementedError:
        raise UsageError(
            f"this shtab is too old to know {shell}: pip install --upgrade shtab"
        ) from None
    return made


class _Parser(ArgumentParser):
    """A parser that notes which arguments are files, ports or messages, by their help."""

    def add_argument(self, *names: Any, **about: Any) -> Action:
        """Add an argument, and note what completes it."""
        metavar = about.get("metavar")
        if metavar == "MESSAGE":
            # Any message can be encoded; a verb with a port completes those that this end sends.
            kinds = MESSAGES if self.prog.endswith(" encode") else tuple(EXCHANGES)
            about["choices"] = [kind.__name__ for kind in kinds]
        elif metavar == "NAME":
            about["choices"] = [*KINDS, *(kind.__name__ for kind in MESSAGES)]
        action = super().add_argument(*names, **about)
        if metavar in _FILES:
            # A port is a file unless it has another name: /dev/ttyUSB0.
            vars(action)["complete"] = import_module("shtab").FILE
        return action
