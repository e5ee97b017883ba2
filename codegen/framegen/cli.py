"""The `framegen` command: finds the verb, runs it, and reports errors in plain words."""

from __future__ import annotations

import argparse
import sys
from contextlib import suppress
from importlib import import_module
from typing import TYPE_CHECKING, Protocol, cast

from framewire.command import console
from framewire.command.console import DONE, UNUSABLE, visible
from framewire.command.shell_completion import CompletionError, add_option

from framegen import __version__
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Sequence

VERBS = (
    "new",
    "check",
    "generate",
    "missing",
    "diff",
    "release",
    "docs",
    "explain",
    "guess",
    "audit",
    "conform",
    "schema",
    "rules",
    "targets",
)


_CLOSING = """\
`framegen VERB --help` shows what else a verb can do.
The exit code is 0 when all is well, 1 when something was found (or the bytes are no frame), and
2 when the input or the command line cannot be used."""


class Verb(Protocol):
    """The interface of a module in `commands`. An example is a command line and what it does.

    It may have an `ABOUT`, too: what else is worth knowing before it is run.
    """

    SUMMARY: str
    EXAMPLES: Sequence[tuple[str, str]]

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the arguments of the verb."""

    def run(self, arguments: argparse.Namespace) -> int:
        """Run the verb, and return the exit code. Raises Unusable."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line. 0: clean; 1: findings, or no frame; 2: unusable input or usage."""
    words = sys.argv[1:] if argv is None else argv
    return console.run("framegen", lambda: _run(words))


def _run(words: Sequence[str]) -> int:
    if words and words[0] in VERBS:
        return _run_verb(words[0], words[1:])
    parser = console.Parser(
        prog="framegen",
        usage="framegen VERB ...",
        description="Check a protocol spec, generate everything from it, explain its frames.",
    )
    parser.add_argument("--version", action="version", version=f"framegen {__version__}")
    add_option(parser)
    parser.add_argument("verb", nargs="?", metavar="VERB", help=argparse.SUPPRESS)
    if {"-h", "--help"} & set(words):
        parser.epilog = _overview()
    known, unknown = parser.parse_known_args(words)
    if known.print_completion is not None:
        return _print_completion(known.print_completion)
    if known.verb is None and unknown:
        parser.error(f"there is no option `{unknown[0]}`")
    if known.verb is None:
        parser.epilog = _overview()
        parser.print_help(sys.stderr)
        return UNUSABLE
    _complain(f"there is no verb `{visible(known.verb)}`", did_you_mean(known.verb, VERBS))
    return UNUSABLE


def _print_completion(shell: str) -> int:
    from framegen.completion import completion  # noqa: PLC0415

    parser = argparse.ArgumentParser(prog="framegen")
    parser.add_argument("--version", action="store_true", help="show the version")
    parts = parser.add_subparsers()
    for name in VERBS:
        verb = _verb(name)
        verb.add_arguments(parts.add_parser(name, help=verb.SUMMARY))
    try:
        print(completion(parser, shell))
    except CompletionError as error:
        _complain(str(error))
        return UNUSABLE
    return DONE


def _run_verb(name: str, words: Sequence[str]) -> int:
    # Only now: --version and a mistyped verb wait for neither YAML nor pydantic.
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    verb = _verb(name)
    parser = console.Parser(
        prog=f"framegen {name}",
        description="\n\n".join((verb.SUMMARY, *_about(verb))),
        epilog=console.table("examples", verb.EXAMPLES),
    )
    verb.add_arguments(parser)
    program: Sequence[str] = []
    if parser.get_default("program") is not None and "--" in words:
        at = words.index("--")
        words, program = words[:at], words[at + 1 :]
    # Intermixed: `55 55 --direction host 02 07` is one list of bytes.
    arguments = parser.parse_intermixed_args(words)
    arguments.program = program
    try:
        return verb.run(arguments)
    except Unusable as error:
        # What was printed before it comes first; if that fails, console.run says so.
        with suppress(OSError):
            sys.stdout.flush()
        _complain(str(error), error.hint)
        return UNUSABLE


def _verb(name: str) -> Verb:
    return cast("Verb", import_module(f"framegen.commands.{name}"))


def _about(verb: Verb) -> list[str]:
    return [verb.ABOUT] if hasattr(verb, "ABOUT") else []


def _overview() -> str:
    verbs = {name: _verb(name) for name in VERBS}
    summaries = [(name, verb.SUMMARY) for name, verb in verbs.items()]
    examples = [verb.EXAMPLES[0] for verb in verbs.values()]
    return "\n\n".join(
        (
            console.table("verbs", summaries),
            console.table("examples", examples),
            *_about(verbs["generate"]),
            _CLOSING,
        )
    )


def _complain(message: str, hint: str = "") -> None:
    print(f"framegen: error: {message}", file=sys.stderr)
    if hint:
        print(f"  hint: {hint}", file=sys.stderr)
