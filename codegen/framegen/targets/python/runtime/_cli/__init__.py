"""The command of this library. Each verb is a module, imported only when it is called."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from importlib import import_module

from .._frame.protocol import PROTOCOL_VERSION
from . import console
from .examples import EXAMPLES, LONG, PROGRAM, SUMMARY, VERBS
from .exit_codes import DONE, MEANINGS, UNUSABLE
from .shell_completion import add_option
from .usage_error import UsageError
from .verbs import verb_named, verbs

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import Any


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line, and return its exit status: one of `exit_codes`."""
    words = sys.argv[1:] if argv is None else list(argv)
    return console.run(PROGRAM, lambda: _run(words))


def _run(words: Sequence[str]) -> int:
    try:
        name = LONG.get(words[0], words[0]) if words else ""
        return _run_verb(name, words[1:]) if name in VERBS else _run_none(words)
    except UsageError as error:
        # Earlier output comes first; if that fails, console.run reports it.
        with suppress(OSError):
            sys.stdout.flush()
        console.complain(PROGRAM, str(error), choices=error.choices)
        return error.code


def _run_verb(name: str, words: Sequence[str]) -> int:
    verb = verb_named(name)
    if hasattr(verb, "hand_over"):
        handed: int = verb.hand_over(words)
        return handed
    parser = _parser(name, verb)
    # Intermixed, so that an option may stand between the words that it belongs to.
    arguments = parser.parse_intermixed_args(words)
    if hasattr(arguments, "port"):
        import_module(".settings", __package__).fill_in(arguments)
    code: int = verb.run(arguments)
    return code


def _parser(name: str, verb: Any) -> console.Parser:
    ends: dict[int, str] = MEANINGS | getattr(verb, "ENDS", {})
    statuses = [(str(code), meaning) for code, meaning in sorted(ends.items())]
    about = [VERBS[name], *([verb.ABOUT] if hasattr(verb, "ABOUT") else [])]
    parser = console.Parser(
        prog=f"{PROGRAM} {name}",
        description="\n\n".join(about),
        epilog="\n\n".join(
            (console.table("examples", EXAMPLES[name]), console.table("exit status", statuses))
        ),
    )
    verb.add_arguments(parser)
    return parser


def _run_none(words: Sequence[str]) -> int:
    here = verbs()
    parser = console.Parser(
        prog=PROGRAM,
        usage=f"{PROGRAM} VERB ...",
        description=SUMMARY,
        epilog="\n\n".join(
            (
                console.table("verbs", here.items()),
                console.table(
                    "examples", [example for verb in here for example in EXAMPLES[verb][:2]]
                ),
                f"`{PROGRAM} VERB --help` shows what else a verb can do.",
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
        version = import_module(".._version", __package__).__version__
        print(f"{PROGRAM} {version}, spec {PROTOCOL_VERSION}")
        return DONE
    if known.print_completion is not None:
        print(verb_named("completion").completion(known.print_completion))
        return DONE
    if known.verb is None:
        parser.print_help(sys.stderr)
        return UNUSABLE
    raise UsageError(f"there is no verb {known.verb!r}; there are {', '.join(here)}")
