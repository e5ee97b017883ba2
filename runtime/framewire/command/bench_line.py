"""The verb `bench-line`: how long requests take on a line, beside the time that the wire needs."""

from __future__ import annotations

import json
import math
import time
from statistics import median

from ..client.long_question import left_out
from ..client.wire_time import WireTime
from ..frame.errors import EncodeError
from ..frame.pluralize import pluralize
from ..line.link_errors import NoReplyError, what_came
from . import link
from .console import visible
from .exit_codes import DONE, INTERRUPTED, NOT_ALL
from .link import add_port, add_timeout, failures_reported, open_client, port_of
from .numerals import at_least
from .progress_thread import shown_progress
from .questions import exchange_named
from .usage_error import UsageError
from .values import fields_as_text, message_from_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from typing import Any

    from ..client.client import Client
    from ..client.library import Library
    from ..frame.message import Message
    from .program import Program

ENDS = link.ENDS | {NOT_ALL: "not every question was answered, or not in full"}
ABOUT = """\
Asks the same question again and again, one at a time, and compares the round trips with what the
bytes of question and answer take on the wire. Questions change nothing."""


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    add_port(parser, program)
    usual = _usual(program.library)
    default = "" if usual is None else f" (default: {usual.__name__})"
    parser.add_argument("message", metavar="MESSAGE", nargs="?", help=f"the question{default}")
    parser.add_argument(
        "fields", nargs="*", metavar="FIELD=VALUE", help="numbers, names of values, or lists"
    )
    parser.add_argument(
        "-n", type=at_least(1), default=100, metavar="COUNT", help="how often (default: 100)"
    )
    add_timeout(parser)
    parser.add_argument("--json", action="store_true", help="print the result as a line of JSON")


def run(arguments: Namespace, program: Program) -> int:
    """Send the requests, and print the result, also when it ended early."""
    limits = program.library.limits.usual
    question = _question(arguments, program.library)
    arguments.port = port_of(arguments, program)
    trips = Trips(question, arguments.port, arguments.baud, program.library)
    with (
        failures_reported(arguments),
        open_client(arguments, program, limits=limits, settle=0) as client,
    ):
        try:
            trips.make(client, arguments.n)
        except KeyboardInterrupt:
            return INTERRUPTED
        finally:
            found = json.dumps(trips.as_record()) if arguments.json else trips.as_text()
            print(found, flush=True)
    return NOT_ALL if trips.errors else DONE


def _usual(library: Library) -> type[Message] | None:
    """Return the default request: the first that needs no fields."""
    questions = (kind for kind, exchange in library.exchanges.items() if exchange.reply is not None)
    return next((kind for kind in questions if not kind.__match_args__), None)


def _question(arguments: Namespace, library: Library) -> Message:
    usual = _usual(library)
    if arguments.message is None and usual is not None:
        return usual()
    exchanges = library.exchanges.items()
    questions = [kind.__name__ for kind, each in exchanges if each.reply is not None]
    known = f"questions are {', '.join(questions) or 'unknown to this protocol'}"
    if arguments.message is None:
        raise UsageError(f"name the question to measure; {known}")
    kind, exchange = exchange_named(arguments.message, library)
    if exchange.reply is None:
        raise UsageError(f"nothing answers {kind.__name__}, so it cannot be timed; {known}")
    question = message_from_text(kind, arguments.fields)
    try:
        exchange.check(question)
    except EncodeError as error:
        raise UsageError(str(error)) from None
    return question


class Trips:
    """Round trips of one request on a port, as many as were made."""

    def __init__(self, question: Message, port: str, baud: float, library: Library) -> None:
        self._question = question
        self._exchanges = library.exchanges
        self._port = port
        self._baud = baud
        self._wire = WireTime(library.link, baud)
        # For each that was answered: the seconds it took, and the size of request and reply.
        self._taken: list[float] = []
        self._sizes: list[int] = []
        self._whole = 0.0
        # Replies that answer nothing, and requests with one sooner than the wire allows.
        self._unsolicited = self._impossible = 0
        # What came to requests without a reply: bytes that are no frame, reports, other replies.
        self._noise = self._reports = self._others = 0
        self.errors: dict[str, int] = {}

    def make(self, client: Client, count: int) -> None:
        """Make `count` round trips. Raises TransportError once the line is lost."""
        began = time.perf_counter()
        try:
            with shown_progress(lambda _: f"{self._requested} of {count} requests; Ctrl-C ends"):
                for _ in range(count):
                    self._make_one(client)
        finally:
            self._whole = time.perf_counter() - began
            self._unsolicited = client.counters.unsolicited
            self._impossible = client.counters.impossible

    def _make_one(self, client: Client) -> None:
        began = time.perf_counter()
        try:
            reply = client.request(self._question)
        except NoReplyError as error:
            self._failed("no reply")
            self._noise += error.noise
            self._reports += error.reports
            self._others += error.unsolicited
            return
        self._taken.append(time.perf_counter() - began)
        self._sizes.append(len(self._question.encode()) + len(reply.encode()))
        if left_out(self._exchanges, self._question, reply)[1]:
            self._failed("incomplete reply")

    def _failed(self, kind: str) -> None:
        self.errors[kind] = self.errors.get(kind, 0) + 1

    @property
    def _requested(self) -> int:
        return len(self._taken) + self.errors.get("no reply", 0)

    def as_record(self) -> dict[str, Any]:
        """Return the result, for JSON: times in seconds."""
        taken = self._taken
        needed = [self._wire.seconds(size) for size in self._sizes]
        return {
            "question": type(self._question).__name__,
            "baud": None if self._baud == math.inf else self._baud,
            "requests": self._requested,
            "answered": len(taken),
            "errors": self.errors,
            "noise": self._noise,
            "reports": self._reports,
            "others": self._others,
            "unsolicited": self._unsolicited,
            "impossible": self._impossible,
            "min": round(min(taken), 6) if taken else None,
            "median": round(median(taken), 6) if taken else None,
            "max": round(max(taken), 6) if taken else None,
            "wire": round(median(needed), 6) if needed else None,
            "per_second": round(len(taken) / self._whole, 3) if self._whole else None,
            "share": round(sum(needed) / self._whole, 4) if sum(needed) else None,
        }

    def as_text(self) -> str:
        """Return the result, for people."""
        found = self.as_record()
        name = " ".join(filter(None, [found["question"], fields_as_text(self._question)]))
        counted = f"{self._requested} requests, {len(self._taken)} answered"
        lines = [f"{name} on {visible(self._port)}: {counted}"]
        if self._taken:
            there, size = len(self._question.encode()), round(median(self._sizes))
            times = [f"{found[each] * 1000:.2f} ms" for each in ("wire", "min", "median", "max")]
            faster = found["median"] < found["wire"]
            hint = "; it is faster than that rate, so try --baud inf" if faster else ""
            line = "on a line that takes no time"
            rate = f"{found['per_second']:.1f} a second"
            if self._baud != math.inf:
                line = f"at {self._baud} baud"
                rate = f"{rate}, {found['share']:.1%} of what the line allows"
            wire = f"{times[0]}: {there} bytes there and {size - there} back, {line}"
            lines += [
                f"  the wire alone  {wire}",
                f"  round trips     min {times[1]}, median {times[2]}, max {times[3]}",
                f"  rate            {rate}{hint}",
            ]
        if self._unsolicited:
            slips = pluralize(self._unsolicited, "reply", "replies")
            lines.append(f"  slips           {slips} to nothing, sent twice or too late: dropped")
        if self._impossible:
            early = pluralize(self._impossible, "question")
            lines.append(
                f"  too soon        {early} had a reply that no such wire can have carried"
            )
        errors = ", ".join(f"{number} {kind}" for kind, number in self.errors.items())
        lines.append(f"  errors          {errors or 'none'}")
        came = self._noise, self._reports, self._others
        # Where others were answered, silence is no hint that the device is off.
        if any(came) or not self._taken:
            lines.append(f"  without a reply {what_came(*came)}")
        return "\n".join(lines)
