"""The verb `monitor`: what a line carries, one line for each frame and each piece of noise."""

from __future__ import annotations

import json
import sys
import time
from contextlib import closing
from pathlib import Path

from ..decoder import StreamDecoder
from ..direction import Direction
from ..exchanges import RECEIVED
from ..noise import Noise
from ..octets import spaced
from ..serial_port import open_transport
from .encode import message_named
from .link import add_port, failures_told
from .unusable import UnusableError
from .values import fields_as_json, fields_as_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable
    from typing import Any, TextIO

    from ..message import Message
    from ..transport import Transport

_SENDERS = {direction.sender: direction for direction in Direction}
# How long a line is quiet before half a frame is given up.
_QUIET = 0.25


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the arguments of the verb."""
    add_port(parser)
    parser.add_argument("--direction", choices=[*_SENDERS, "any"], help="who sends there")
    parser.add_argument(
        "-t",
        choices=["absolute", "delta", "zero"],
        default="zero",
        dest="time",
        help="time of day in s, s since the line before, or s since the start (default: zero)",
    )
    parser.add_argument(
        "--only", action="append", default=[], metavar="NAME", help="a message, or noise"
    )
    parser.add_argument("--log", type=Path, metavar="FILE", help="write all of it for `decode`")
    parser.add_argument("-n", type=int, metavar="N", help="end after so many lines")
    parser.add_argument("--json", action="store_true", help="print lines of JSON")


def run(arguments: Namespace) -> int:
    """Prints until Ctrl-C, -n or the loss of the line, and then the totals."""
    if arguments.n is not None and arguments.n < 1:
        raise UnusableError(f"-n is {arguments.n}, and must be above 0")
    with failures_told(), closing(open_transport(arguments.port)) as transport:
        clock = time.time if arguments.time == "absolute" else time.monotonic
        try:
            log = None if arguments.log is None else arguments.log.open("w", encoding="ascii")
        except OSError as error:
            raise UnusableError(f"{arguments.log} cannot be written: {error.strerror}") from None
        try:
            Monitor(arguments, sys.stdout, clock, log).watch(transport)
        finally:
            if log is not None:
                log.close()
    return 0


class Monitor:
    """Shows what a transport brings, on a screen and by a clock that are handed in."""

    def __init__(
        self,
        arguments: Namespace,
        screen: TextIO,
        clock: Callable[[], float],
        log: TextIO | None = None,
    ) -> None:
        self._screen = screen
        self._clock = clock
        self._log = log
        self._form = arguments.time
        self._left: int | None = arguments.n
        self._json = arguments.json
        self._only = {
            "noise" if name == "noise" else message_named(name).__name__ for name in arguments.only
        }
        named = arguments.direction
        self._decoder = StreamDecoder(_SENDERS.get(named) if named else RECEIVED)
        self._since = self._last = clock()

    def watch(self, transport: Transport) -> None:
        """Reads and shows, until so many lines were shown; the totals come in any case."""
        heard = self._clock()
        try:
            while self._left != 0:
                data = transport.read(_QUIET)
                now = self._clock()
                events = self._decoder.feed(data)
                if data:
                    heard = now
                elif self._decoder.pending and now - heard >= _QUIET:
                    events = self._decoder.flush()
                self._show(events, now)
        finally:
            seen = self._decoder.counters
            totals = f"{seen.fed} bytes, {seen.messages} messages, {seen.noise} bytes of noise"
            print(totals, file=sys.stderr)

    def _show(self, events: list[Message | Noise], now: float) -> None:
        for event in events:
            noise = isinstance(event, Noise)
            who = "noise" if isinstance(event, Noise) else event.DIRECTION.sender
            data = event.data if isinstance(event, Noise) else event.encode()
            what = event.reason.value if isinstance(event, Noise) else type(event).__name__
            if self._log is not None:
                self._log.write(f"{spaced(data)}  # {now - self._since:.6f} s, {who}: {what}\n")
                self._log.flush()
            if self._left == 0 or (self._only and (who if noise else what) not in self._only):
                continue
            if self._left is not None:
                self._left -= 1
            since = {"absolute": 0.0, "delta": self._last, "zero": self._since}[self._form]
            at, self._last = now - since, now
            if self._json:
                record: dict[str, Any] = {"time": round(at, 6), "from": who, "hex": spaced(data)}
                record |= {"reason": what} if isinstance(event, Noise) else {"message": what}
                if not isinstance(event, Noise):
                    record["fields"] = fields_as_json(event)
                line = json.dumps(record)
            else:
                told = what if isinstance(event, Noise) else f"{what} {fields_as_text(event)}"
                line = f"{at:12.6f}  {who:10}  {spaced(data)} | {told.rstrip()}"
            print(line, file=self._screen, flush=True)
