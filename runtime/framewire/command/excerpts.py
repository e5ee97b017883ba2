"""The options that name a part of a recording, by its times."""

from __future__ import annotations

from argparse import ArgumentTypeError

from ..recording.excerpt import Excerpt, ExcerptError, Moment
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace


def add_excerpt(parser: ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument(
        "--from",
        type=_moment,
        dest="begin",
        metavar="T",
        help="only what came from then on: 90, 1m30s or 1h since the recording began, or the time "
        "of day, as 2026-01-31T09:05:00Z (without a zone: UTC)",
    )
    parser.add_argument(
        "--to", type=_moment, dest="end", metavar="T", help="only what came up to then, as --from"
    )


def excerpt_of(arguments: Namespace) -> Excerpt | None:
    """Return what was asked for; None for the whole recording. Raises UsageError."""
    if arguments.begin is None and arguments.end is None:
        return None
    try:
        return Excerpt(arguments.begin, arguments.end)
    except ExcerptError as error:
        raise UsageError(str(error)) from None


def _moment(text: str) -> Moment:
    try:
        return Moment(text)
    except ValueError as error:
        raise ArgumentTypeError(str(error)) from None
