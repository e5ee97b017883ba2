"""Statistics and traces of a recording, for `stats`: apart, since they need the extra `tables`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..recording.excerpt import ExcerptError
from ..tables.stats.statistics import Statistics, statistics
from ..tables.stats.traces import Traces
from .capture import direction_in
from .excerpts import excerpt_of
from .usage_error import UsageError

if TYPE_CHECKING:
    from argparse import Namespace

    from ..line.link import Link
    from .recording import Recording


def measured(
    recording: Recording, form: str, arguments: Namespace, link: Link
) -> tuple[Statistics, Traces | None]:
    """Return what a recording holds, and the traces of its readings if they are to be drawn.

    Raises UsageError.
    """
    codec, traces = recording.codec, None
    if arguments.plot is not None:
        traces = Traces(link.bits_per_byte / arguments.baud, codec.received)
    try:
        found = statistics(
            codec,
            recording,
            form=form,
            direction=direction_in(arguments, codec),
            traces=traces,
            excerpt=excerpt_of(arguments),
            ids=arguments.ids,
        )
    except ExcerptError as error:
        raise UsageError(f"{recording.name}: {error}") from None
    return found, traces
