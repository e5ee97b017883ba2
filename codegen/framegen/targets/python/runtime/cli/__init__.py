"""The command of this library. Each verb is a module, imported only when it is asked for."""

from __future__ import annotations

import argparse
import os
import sys
from importlib import import_module

from .. import __version__
from .examples import EXAMPLES, PROGRAM, SUMMARY, VERBS
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import NoReturn

OK, UNUSABLE = 0, 2
# What a shell reports for a program that SIGINT or SIGPIPE ended.
INTERRUPTED, READER_GONE = 130, 141


def main(argv: Sequence[str] | None = None) -> int:
    """Runs the command line. 0: done; 1: noise (--strict), or no reply; 2: unusable."""
    words = sys.argv[1:] if argv is None else list(argv)
    try:
        code = _run_verb(words[0], words[1:]) if words and words[0] in VERBS else _run_none(words)
        sys.stdout.flush()
    except SystemExit as stop:  # argparse has said what there was to say
        return stop.code if isinstance(stop.code, int) else OK
    except UnusableError as error:
        sys.stdout.flush()
        print(f"{PROGRAM}: error: {error}", file=sys.stderr)
        return UNUSABLE
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        # What is left goes nowhere, so that the interpreter does not fail on it at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return READER_GONE
    return code


def _run_verb(name: str, words: Sequence[str]) -> int:
    verb = import_module(f"{__name__}.{name.replace('-', '_')}")
    if hasattr(verb, "hand_over"):
        handed: int = verb.hand_over(words)
        return handed
    parser = _Parser(
        prog=f"{PROGRAM} {name}",
        description=VERBS[name],
        epilog=_listed("examples", EXAMPLES[name]),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    verb.add_arguments(parser)
    # Intermixed, so that an option may stand between the words that it is about.
    code: int = verb.run(parser.parse_intermixed_args(words))
    return code


def _run_none(words: Sequence[str]) -> int:
    parser = _Parser(
        prog=PROGRAM,
        usage=f"{PROGRAM} VERB ...",
        description=SUMMARY,
        epilog="\n\n".join(
            (
                _listed("verbs", VERBS.items()),
                _listed("examples", [example for verb in VERBS for example in EXAMPLES[verb][:2]]),
                f"`{PROGRAM} VERB --help` shows what else a verb can do.",
            )
        ),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {__version__}")
    parser.add_argument("verb", nargs="?", metavar="VERB", help=argparse.SUPPRESS)
    known, _ = parser.parse_known_args(words)
    if known.verb is None:
        parser.print_help(sys.stderr)
        return UNUSABLE
    raise UnusableError(f"there is no verb {known.verb!r}; there are {', '.join(VERBS)}")


def _listed(title: str, entries: Iterable[tuple[str, str]]) -> str:
    rows = list(entries)
    width = max(len(left) for left, _ in rows)
    return "\n".join([f"{title}:", *(f"  {left:<{width}}  {right}" for left, right in rows)])


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, and where the examples are."""

    def error(self, message: str) -> NoReturn:
        raise UnusableError(f"{message}\n  `{self.prog} --help` shows how it is used")
