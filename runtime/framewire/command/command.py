"""Run a command line. Each verb is a module, imported only when it is called."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from importlib import import_module

from . import console
from .exit_codes import DONE, MEANINGS, UNUSABLE
from .shell_completion import add_option
from .usage_error import UsageError
from .verbs import verb_named

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any

    from .program import Program


def run(program: Program, words: Sequence[str]) -> int:
    """Run the command line, and return its exit status: one of `exit_codes`."""
    return console.run(program.name, lambda: _run(program, words))


def _run(program: Program, words: Sequence[str]) -> int:
    try:
        name = program.long.get(words[0], words[0]) if words else ""
        if name in program.verbs:
            return _run_verb(program, name, words[1:])
        return _run_none(program, words)
    except UsageError as error:
        # Earlier output comes first; if that fails, console.run reports it.
        with suppress(OSError):
            sys.stdout.flush()
        console.complain(program.name, str(error), choices=error.choices)
        return error.code


def _run_verb(program: Program, name: str, words: Sequence[str]) -> int:
    verb = verb_named(name, program)
    if hasattr(verb, "hand_over"):
        handed: int = verb.hand_over(words, program)
        return handed
    parser = _parser(program, name, verb)
    # Intermixed, so that an option may stand between the words that it belongs to.
    arguments = parser.parse_intermixed_args(words)
    if hasattr(arguments, "port"):
        import_module(".settings", __package__).fill_in(arguments, program)
    code: int = verb.run(arguments, program)
    return code


def _parser(program: Program, name: str, verb: Any) -> console.Parser:
    # Constants of a verb that says the same of every protocol, and else functions.
    ends = verb.ends(program) if hasattr(verb, "ends") else getattr(verb, "ENDS", {})
    about = verb.about(program) if hasattr(verb, "about") else getattr(verb, "ABOUT", "")
    statuses = [(str(code), meaning) for code, meaning in sorted((MEANINGS | ends).items())]
    parser = console.Parser(
        prog=f"{program.name} {name}",
        description="\n\n".join(filter(None, (program.verbs[name], about))),
        epilog="\n\n".join(
            (
                console.table("examples", program.examples[name]),
                console.table("exit status", statuses),
            )
        ),
    )
    verb.add_arguments(parser, program)
    return parser


def _run_none(program: Program, words: Sequence[str]) -> int:
    here = program.verbs
    parser = console.Parser(
        prog=program.name,
        usage=f"{program.name} VERB ...",
        description=program.summary,
        epilog="\n\n".join(
            (
                console.table("verbs", here.items()),
                console.table(
                    "examples", [example for verb in here for example in program.examples[verb][:2]]
                ),
                f"`{program.name} VERB --help` shows what else a verb can do.",
            )
        ),
    )
    # Not argparse's: the version is looked up only when it is printed.
    parser.add_argument(
        "--version", action="store_true", help="show program's version number and exit"
    )
    add_option(parser)
    parser.add_argument("verb", nargs="?", metavar="VERB", help=argparse.SUPPRESS)
    known, _ = parser.parse_known_args(words)
    if known.version:
        print(f"{program.name} {program.library.versions}")
        return DONE
    if known.print_completion is not None:
        module = import_module(".completion", __package__)
        print(module.completion(known.print_completion, program))
        return DONE
    if known.verb is None:
        parser.print_help(sys.stderr)
        return UNUSABLE
    raise UsageError(f"there is no verb {known.verb!r}; there are {', '.join(here)}")
