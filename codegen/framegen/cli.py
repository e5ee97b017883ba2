"""The `framegen` command: finds the verb, runs it, and turns what goes wrong into plain words."""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import sys
from importlib import import_module
from typing import TYPE_CHECKING, NoReturn, Protocol, cast

from framegen import __version__
from framegen.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

CLEAN, FINDINGS, UNUSABLE = 0, 1, 2
# What a shell reports for a program that SIGINT or SIGPIPE ended.
INTERRUPTED, READER_GONE = 130, 141

VERBS = ("check", "generate", "diff", "docs", "explain", "schema", "rules")


_CLOSING = """\
`framegen VERB --help` shows what else a verb can do.
The exit code is 0 when all is well, 1 when something was found (or the bytes are no frame), and
2 when the input or the command line was of no use."""


class Verb(Protocol):
    """What a module in `commands` offers. An example is a command line and what it does."""

    SUMMARY: str
    EXAMPLES: Sequence[tuple[str, str]]

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Declare the arguments of the verb."""

    def run(self, arguments: argparse.Namespace) -> int:
        """Do it, and give the exit code. Raises Unusable."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line. 0: clean; 1: findings, or no frame; 2: unusable input or usage."""
    _never_fail_to_print()
    try:
        code = _run(sys.argv[1:] if argv is None else argv)
        sys.stdout.flush()
    except SystemExit as stop:  # argparse has said what there was to say
        return stop.code if isinstance(stop.code, int) else CLEAN
    except ModuleNotFoundError as error:
        if error.name is None or error.name.startswith("framegen"):
            raise
        _complain(
            f"the generator needs `{error.name}`, which is not installed",
            "pip install 'busservo[codegen]'",
        )
        return UNUSABLE
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        _discard_output()
        return READER_GONE
    except OSError as error:
        _discard_output()
        where = "" if error.filename is None else f"{error.filename}: "
        _complain(f"{where}{error.strerror or error}")
        return UNUSABLE
    return code


def _run(words: Sequence[str]) -> int:
    if words and words[0] in VERBS:
        return _run_verb(words[0], words[1:])
    parser = _Parser(
        prog="framegen",
        usage="framegen VERB ...",
        description="Check a protocol spec, generate everything from it, explain its frames.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"framegen {__version__}")
    parser.add_argument("verb", nargs="?", metavar="VERB", help=argparse.SUPPRESS)
    if {"-h", "--help"} & set(words):
        parser.epilog = _overview()
    known, unknown = parser.parse_known_args(words)
    if known.verb is None and unknown:
        parser.error(f"there is no option `{unknown[0]}`")
    if known.verb is None:
        parser.epilog = _overview()
        parser.print_help(sys.stderr)
        return UNUSABLE
    _complain(f"there is no verb `{_visible(known.verb)}`", did_you_mean(known.verb, VERBS))
    return UNUSABLE


def _run_verb(name: str, words: Sequence[str]) -> int:
    # Only now: --version and a mistyped verb wait for neither YAML nor pydantic.
    from framegen.yamltree import Unusable  # noqa: PLC0415

    verb = _verb(name)
    parser = _Parser(
        prog=f"framegen {name}",
        description=verb.SUMMARY,
        epilog=_listed("examples", verb.EXAMPLES),
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    verb.add_arguments(parser)
    # Intermixed: `55 55 --direction host 02 07` is one list of bytes.
    arguments = parser.parse_intermixed_args(words)
    try:
        return verb.run(arguments)
    except Unusable as error:
        sys.stdout.flush()
        _complain(str(error), error.hint)
        return UNUSABLE


def _verb(name: str) -> Verb:
    return cast("Verb", import_module(f"framegen.commands.{name}"))


def _overview() -> str:
    verbs = {name: _verb(name) for name in VERBS}
    summaries = [(name, verb.SUMMARY) for name, verb in verbs.items()]
    examples = [verb.EXAMPLES[0] for verb in verbs.values()]
    return "\n\n".join((_listed("verbs", summaries), _listed("examples", examples), _CLOSING))


def _listed(title: str, entries: Iterable[tuple[str, str]]) -> str:
    rows = list(entries)
    width = max(len(left) for left, _ in rows)
    return "\n".join([f"{title}:", *(f"  {left:<{width}}  {right}" for left, right in rows)])


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, and where the examples are."""

    def error(self, message: str) -> NoReturn:
        _complain(_visible(message), f"`{self.prog} --help` shows how it is used")
        raise SystemExit(UNUSABLE)


def _complain(message: str, hint: str = "") -> None:
    print(f"framegen: error: {message}", file=sys.stderr)
    if hint:
        print(f"  hint: {hint}", file=sys.stderr)


def _visible(text: str) -> str:
    """Show what was typed, without the power to clear the screen."""
    return "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in text)


def _never_fail_to_print() -> None:
    """Let a terminal of few characters show the others as escapes, instead of failing on them."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors == "strict":
            stream.reconfigure(errors="backslashreplace")


def _discard_output() -> None:
    """Send what is left nowhere, so that the interpreter does not fail on it at exit."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    with contextlib.suppress(OSError, ValueError):  # it is no file, and fails on nothing
        os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
