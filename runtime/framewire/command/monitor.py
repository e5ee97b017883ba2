"""The verb `monitor`: what a line carries, one line for each frame and each piece of noise."""

from __future__ import annotations

import sys
import time
from contextlib import closing
from pathlib import Path

from ..codec.gap import GAP
from ..frame.pluralize import pluralize
from ..recording.file import EITHER, NOISE
from . import link
from .encode import message_named
from .events import UNKNOWN, kinds, names_of, sender_of, totals
from .exit_codes import DONE, INTERRUPTED
from .lines import TIMES, Lines
from .link import add_port, failures_reported, open_line, port_of
from .numerals import at_least
from .progress import PROGRESS_INTERVAL, Progress
from .recorder import Recorder
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable, Sequence
    from typing import TextIO

    from ..codec.noise import Noise
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message
    from ..line.transport import Transport
    from .program import Program

ENDS = link.ENDS
ABOUT = """\
One line for each frame and each piece of noise: the time, who sent it, what it says, its bytes.
Ctrl-C ends it, and the totals follow on the error stream. Colours are shown on terminals only, and
not where NO_COLOR is set."""
# How long one read may take, so that Ctrl-C is noticed on every system.
_POLL_INTERVAL = 0.25


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    codec = program.library.codec
    add_port(parser, program, client=False)
    # If nothing is sent to a client in this protocol, a monitor looks at what a client sends.
    comes = any(kind.DIRECTION is codec.received for kind in codec.messages)
    received = next(name for name, way in codec.named.items() if way is codec.received)
    usual = received if comes else "any"
    readers = "`decode` and `replay`" if "replay" in program.verbs else "`decode`"
    parser.add_argument(
        "--direction",
        choices=[*codec.named, "any"],
        default=usual,
        help=f"who sends on this line; any: both ends do, and what both may have sent is shown as "
        f"`either` (default: {usual})",
    )
    parser.add_argument(
        "-t",
        choices=TIMES,
        default="zero",
        dest="time",
        help="the time of day, seconds since the line before, or since the start (default: zero)",
    )
    parser.add_argument(
        "--only",
        action="append",
        default=[],
        metavar="NAME",
        help=f"show only this: a message, {', '.join(kinds(codec))}; may be given several times",
    )
    parser.add_argument(
        "--hide",
        action="append",
        default=[],
        metavar="NAME",
        help="hide this: a name as for --only",
    )
    parser.add_argument(
        "--log",
        type=Path,
        metavar="FILE",
        help=f"record all of it, shown or not, for {readers}; a FILE that holds anything is never "
        "overwritten",
    )
    parser.add_argument("-n", type=at_least(1), metavar="N", help="end after so many lines")
    parser.add_argument(
        "--json",
        action="store_true",
        help="print lines of JSON; absolute times are seconds since 1970",
    )


def run(arguments: Namespace, program: Program) -> int:
    """Print until Ctrl-C, -n or the loss of the line, and then the totals."""
    # Names are checked before a port is opened or a file begun.
    codec = program.library.codec
    monitor = Monitor(arguments, sys.stdout, codec)
    port = port_of(arguments, program)
    with (
        failures_reported(arguments),
        closing(open_line(port, arguments.baud, program.library)) as line,
        Recorder(arguments.log, codec) as recorder,
    ):
        recorder.begin(port, time.monotonic())
        try:
            monitor.watch(line, recorder)
        except KeyboardInterrupt:
            return INTERRUPTED
    return DONE


class Monitor:
    """A view of what a transport receives, on a given screen and by given clocks."""

    def __init__(
        self,
        arguments: Namespace,
        screen: TextIO,
        codec: ProtocolCodec,
        *,
        clock: Callable[[], float] = time.monotonic,
        day: Callable[[], float] = time.time,
    ) -> None:
        self._clock = clock
        self._day = day
        self._absolute = arguments.time == "absolute"
        self._left: int | None = arguments.n
        self._only = {_filter(name, codec) for name in arguments.only}
        self._hidden = {_filter(name, codec) for name in arguments.hide}
        self._codec = codec
        self._direction = codec.named.get(arguments.direction)
        self._decoder = codec.decoder(self._direction)
        self._progress = Progress(sys.stderr)
        self._lines = Lines(screen, codec, arguments.time, as_json=arguments.json)

    def watch(self, line: Transport, recorder: Recorder) -> None:
        """Read and print, up to the given number of lines; the totals come in any case."""
        shown = self._clock()
        self._lines.begin(self._day() if self._absolute else shown)
        try:
            while self._left != 0:
                data = line.read(GAP if self._decoder.pending else _POLL_INTERVAL)
                now = self._clock()
                before = self._lines.count
                if data:
                    self._tell(self._decoder.feed(data), recorder, now)
                elif self._decoder.pending:
                    # Quiet for so long: half a frame must not grow together with the next.
                    self._tell(self._decoder.flush(), recorder, now)
                    recorder.quiet()
                if self._lines.count != before:
                    shown = now
                elif now - shown >= PROGRESS_INTERVAL:
                    self._progress.show(self._so_far(now - shown))
        finally:
            self._progress.end()
            try:
                # What was held back for the rest of a frame was received as well.
                self._tell(self._decoder.flush(), recorder, self._clock())
            finally:
                print(self._totals(), file=sys.stderr)

    def _tell(self, events: Sequence[Message | Noise], recorder: Recorder, now: float) -> None:
        """Record all events, and print the chosen ones."""
        recorder.record(events, self._direction, now)
        when = self._day() if self._absolute else now
        for event in events:
            if self._left != 0 and self._wanted(event):
                self._progress.clear()
                self._lines.show(event, self._direction, when)
                if self._left is not None:
                    self._left -= 1

    def _wanted(self, event: Message | Noise) -> bool:
        who = sender_of(event, self._direction, self._codec)
        names = {who, *names_of(event, self._direction, self._codec)}
        # An unknown frame counts as noise, too, and an event of either end as one of both.
        wider = names | {UNKNOWN: {NOISE}, EITHER: {*self._codec.senders}}.get(who, set())
        return (not self._only or bool(wider & self._only)) and not names & self._hidden

    def _so_far(self, waited: float) -> str:
        seen = self._decoder.counters
        if not seen.fed:
            return f"nothing received for {waited:.0f} s (Ctrl-C ends)"
        return f"nothing to show for {waited:.0f} s (Ctrl-C ends); {totals(seen)}"

    def _totals(self) -> str:
        filtered = f"; {pluralize(self._lines.count, 'line')} shown"
        return totals(self._decoder.counters) + (filtered if self._only or self._hidden else "")


def _filter(name: str, codec: ProtocolCodec) -> str:
    known = kinds(codec)
    if name in known:
        return name
    try:
        return message_named(name, codec).__name__
    except UsageError as error:
        raise UsageError(f"{error}; besides messages, there are {', '.join(known)}") from None
