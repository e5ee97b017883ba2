"""`framegen diff`: what breaks between two editions of a spec, tried out and shown."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable

    from framegen.comparison.comparison import Comparison
    from framegen.comparison.report.view import View

FORMATS = ("text", "json", "markdown", "github")
FAILURES = ("wire", "conversation", "programs", "uncertain", "version", "never")
USUAL = ("wire", "conversation", "programs", "uncertain")

SUMMARY = "Compare two editions of a spec, and show what breaks between their users."
EXAMPLES = (
    ("framegen diff", "from the newest edition in spec/released, or else HEAD, to the spec here"),
    ("framegen diff busservo", "the same for one spec of several"),
    ("framegen diff v1.0.0", "from a git revision: a tag, a branch, HEAD~3"),
    ("framegen diff v1.0.0:spec/old.yaml new.yaml", "a file at a revision; - is the input"),
    ("framegen diff busservo-1.0.0 HEAD", "from a released edition to the last commit"),
    ("framegen diff --fail-on wire,version", "1 where the wire breaks, 4 without a new version"),
    ("framegen diff --format markdown", "the entry for `history`, and a table of what breaks"),
)
_AXES = """\
wire          frames that the other end refuses or misreads: every message of either edition is
              encoded at its edges, and read with the other edition
conversation  replies, reports, times, and the line
programs      what was written for the old library
uncertain     a name that changed, until the spec says `was: OldName`; a reservation that is gone
version       the version of the spec was not raised as it should be
never         nothing of this
Of a spec that is gone, the wire and programs break.
Without OLD, or with a revision, older editions in spec/released count where they misread frames.
What breaks on purpose, as `breaks` in the history of the spec says, is shown and does not count."""
_EXIT_CODES = """\
0  nothing that counts
1  something breaks
2  the input cannot be used, or there is nothing to compare
3  only what is uncertain breaks
4  only the version is missing"""


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "old",
        nargs="?",
        metavar="OLD",
        help="a file, -, a git revision, REVISION:FILE or a released edition, as busservo-1.0.0",
    )
    parser.add_argument(
        "new", nargs="?", metavar="NEW", help="a later one; without it, spec/NAME.yaml as it is"
    )
    parser.add_argument(
        "--format", choices=FORMATS, default="text", help="how to show it; text without this"
    )
    parser.add_argument(
        "--fail-on",
        action="append",
        type=_failures,
        metavar="WHAT",
        help=f"what counts, several by commas: {','.join(USUAL)} without this",
    )
    parser.add_argument_group("what counts", _AXES)
    parser.add_argument_group("exit codes", _EXIT_CODES)


def _failures(text: str) -> list[str]:
    words = [word.strip() for word in text.split(",")]
    for word in words:
        if word not in FAILURES:
            known = ", ".join(FAILURES)
            raise argparse.ArgumentTypeError(f"{word!r} is none of {known}")
    return words


def run(arguments: Namespace) -> int:
    """Print a report of each pair of editions. Return the exit code that --fail-on gives it."""
    from framegen.comparison.comparison import Comparison  # noqa: PLC0415
    from framegen.comparison.editions import find_editions  # noqa: PLC0415
    from framegen.comparison.report import FORMATS as RENDERERS  # noqa: PLC0415
    from framegen.comparison.report import gone  # noqa: PLC0415

    fail_on = _fail_on(arguments.fail_on)
    editions = find_editions(arguments.old, arguments.new)
    statuses: list[int] = []
    between = "" if arguments.format == "json" else "\n"
    unread: list[str] = []
    for old, new in editions.pairs:
        comparison = Comparison(old, new, editions.kept(old))
        report, status = _report(comparison, RENDERERS[arguments.format], fail_on)
        print(between * bool(statuses) + report, end="")
        statuses.append(status)
        unread += comparison.found_in_kept.unread
    for each in editions.gone:
        print(between * bool(statuses) + gone.FORMATS[arguments.format](each), end="")
        statuses.append(gone.exit_status(fail_on))
    sys.stdout.flush()
    for why in (*editions.left_out, *unread):
        print(f"not compared: {why}", file=sys.stderr)
    return min((status for status in statuses if status), default=0)


def _report(
    comparison: Comparison, render: Callable[[View], str], fail_on: frozenset[str]
) -> tuple[str, int]:
    """Return the report on two editions, and its exit code."""
    from framegen.comparison.report.verdict import exit_status  # noqa: PLC0415
    from framegen.comparison.report.view import View  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    view = View(comparison)
    both = comparison.old, comparison.new
    disliked = next((each for each in both if each.compiled.tolerated), None)
    try:
        _refuse_strangers(view)
        return render(view), exit_status(view.effects, view.version_finding, fail_on)
    except Unusable:
        raise
    except Exception:
        if disliked is None:
            raise
        # What a rule is there to prevent may have any consequence.
        first = disliked.compiled.tolerated[0].render(disliked.compiled.source)
        raise Unusable(
            f"{disliked.label} contradicts itself too much to be compared; first,\n{first}",
            hint="`framegen check` shows all findings of a spec file",
        ) from None


def _refuse_strangers(view: View) -> None:
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    old, new = (each.spec.protocol.name for each in (view.old, view.new))
    if old != new and not view.pair.messages.to_new:
        raise Unusable(
            f"a comparison of nothing: {view.old.label} is `{old}` and {view.new.label} is "
            f"`{new}`, and they have no message in common",
            hint="name two editions of one protocol",
        )


def _fail_on(given: list[list[str]] | None) -> frozenset[str]:
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    words = frozenset(USUAL if given is None else (word for each in given for word in each))
    if "never" in words and len(words) > 1:
        others = ", ".join(sorted(words - {"never"}))
        raise Unusable(
            f"`--fail-on never` and {others} exclude each other", hint="leave one of them out"
        )
    return words
