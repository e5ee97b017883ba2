"""What both clients do, whoever waits and however: no thread, and no event loop.

A call that takes its time is written once, as a generator of what it waits for: a request until it
is done, or else any change up to a time. A client only knows how to wait.
"""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Iterable
from operator import index
from os import PathLike

from ..codec.counters import LineCounters
from ..frame.errors import EncodeError
from ..frame.message import Message
from ..line.error_mapping import ErrorMapping
from ..line.link_errors import (
    ClosedError,
    IncompleteReplyError,
    NoReportError,
    TransportError,
)
from ..line.transport import Transport
from .library import Library
from .limits import Allowed
from .long_question import left_out, parts_of
from .report_filter import ReportFilter
from .request import Request, Run, Sent
from .session import Session
from .trace import Trace

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Generator, Mapping
    from typing import Any, TypeAlias, TypeVar

    import typing_extensions as typing

    from .pose import Pose
    from .report_filter import Kinds

    _Result = TypeVar("_Result")
    _Reply = TypeVar("_Reply", bound=Message)

    # A request is waited for until it is done; a time is when to go on if nothing changes before.
    Wait: TypeAlias = Request | float | None
    Steps: TypeAlias = Generator[Wait, None, _Result]
else:
    from ..frame.typing_later import typing

REPLY_TIMEOUT = 0.25
REPORT_LIMIT = 1024
# How long one read may take, so that whoever waits for something else is not delayed.
POLL_INTERVAL = 0.02
# How long draining may take, beyond the calculated time of the bytes.
DRAIN_TIMEOUT = 1.0
_ENDLESS = float("inf")
_NEVER_CLOSED = "use the client in a `with`, or call close()"


class BaseClient:
    """A session and the line that it is held over. A library's own client says whose it is."""

    _library: typing.ClassVar[Library]

    def __init__(
        self,
        transport: Transport,
        *,
        baud: float | None,
        reply_timeout: float,
        retries: int,
        trace: str | PathLike[str] | None,
        report_limit: int,
        limits: Allowed | str,
        ids: Iterable[int],
        clock: Callable[[], float],
        local_echo: bool | None,
        settle: float | None,
    ) -> None:
        library = self._library
        link = library.link
        addressed = any(each.address.field for each in library.exchanges.values())
        self._limits = library.limits.chosen(limits, addressed=addressed)
        self._ids = _chosen_ids(ids, library.pose)
        self._transport = ErrorMapping(transport, library.log)
        self._name = self._transport.name
        self._retries = retries
        self._clock = clock
        # Whether the clock goes on while a thread sleeps.
        self._real_time = clock is time.monotonic
        self._trace = Trace(library.log, self._name, trace)
        self._session = Session(
            library,
            baud=link.baud if baud is None else baud,
            reply_timeout=reply_timeout,
            report_limit=report_limit,
            trace=self._trace,
            limits=self._limits,
            local_echo=link.local_echo if local_echo is None else local_echo,
            settle=settle,
            name=self._name,
            now=clock(),
        )
        self._session.largest_frame = self._transport.largest_frame
        self._callbacks: dict[object, Callable[[Message], object]] = {}
        self._failure: TransportError | None = None
        self._closing = False

    def __repr__(self) -> str:
        state = "closed" if self._closing else "failed" if self._failure else "open"
        return f"<{type(self).__name__} on {self._name}, {state}>"

    def __del__(self, warn: Callable[..., None] = warnings.warn) -> None:
        # A client whose construction failed has nothing to close.
        if getattr(self, "_closing", True):
            return
        self._closing = True
        try:
            warn(f"{self._name} was never closed: {_NEVER_CLOSED}", ResourceWarning, source=self)
        finally:
            self._abandon()
            self._transport.close()
            self._trace.close()

    @property
    def closed(self) -> bool:
        """Whether it has been closed at this end."""
        return self._closing

    @property
    def counters(self) -> LineCounters:
        """What has passed on the line so far."""
        return self._session.counters

    def send_latest(self, message: Message) -> None:
        """Send a command when the line is free, unless a newer one replaces it; do not wait.

        It replaces a queued command of the same class for the same ids, or for fewer. So a stream
        of commands faster than the line is thinned out instead of falling behind. Raises LimitError
        for values outside the limits.
        """
        self._submit_latest(message)

    def _asked(self, ids: Iterable[int] | None) -> Iterable[int]:
        """Return the numbers that are asked about: those given, or those of this client."""
        if ids is not None:
            return ids
        if not self._ids:
            raise EncodeError("ids", ids, "give them here, or as ids=… when the client is opened")
        return self._ids

    # ------------------------------------------------------------------ what each client adds

    def _motion(self, request: Request) -> Sent:
        """Return what a command is that lasts."""
        raise NotImplementedError

    def _submit_latest(self, message: Message) -> Request:
        """Submit a command that may be overtaken."""
        raise NotImplementedError

    def _wake(self) -> None:
        """Have all who wait look again."""
        raise NotImplementedError

    def _abandon(self) -> None:
        """End what would use the line after it was given back."""

    # ------------------------------------------------------------------ calls, step by step

    def _exchange(
        self, message: Message, retries: int | None, within: float | None = None
    ) -> Steps[Request]:
        """Submit a message, a command where `retries` is None, and wait until it is done."""
        self._check()
        question = retries is not None
        request = self._session.submit(
            message, question=question, retries=retries or 0, within=within
        )
        yield request
        return self._ended(request)

    def _ended(self, request: Request) -> Request:
        """Return a request that is done. Raises the error that it ended with."""
        if request.reply is None and self._failure is not None:
            # A command whose frame the port did not take counts as done, but is not.
            raise self._failure.again()
        if request.error is not None:
            error = request.error
            raise error.again() if isinstance(error, TransportError) else error
        return request

    def _command(self, message: Message) -> Steps[Request]:
        """Send a command."""
        return self._exchange(message, None)

    def _sent(self, request: Request) -> Sent:
        """Return what became of a command."""
        if request.sent is None:
            raise AssertionError(f"{request.message!r} ended without an error, and was not sent")
        return request.sent if request.exchange.lasts is None else self._motion(request)

    def _acknowledged(self, message: Message) -> Steps[Run]:
        """Send a command that is acknowledged."""
        request = yield from self._exchange(message, None)
        if not isinstance(request.sent, Run):
            raise TypeError(f"{message!r} is acknowledged by nothing")
        return request.sent

    def _question(self, message: Message, retries: int | None = None) -> Steps[Message]:
        """Send a question; give the reply, whole or not."""
        request = yield from self._exchange(message, self._retries if retries is None else retries)
        return self._good_reply(request)

    def _good_reply(self, request: Request) -> Message:
        """Return what has answered a question. Raises the error that it tells of."""
        if request.reply is None:
            raise AssertionError(f"{request.message!r} ended without an error and without a reply")
        error = request.exchange.failures.error(request.message, request.reply)
        if error is not None:
            raise error
        return request.reply

    def _gathered(self, message: Message, within: float) -> Steps[list[Message]]:
        """Send a question to all; give what comes back within so many seconds."""
        if not 0 <= within < _ENDLESS:
            problem = f"within is {within!r}, and must be 0 seconds or more, and not endless"
            raise ValueError(problem)
        request = yield from self._exchange(message, 0, within)
        return request.gathered

    def _reply(self, message: Message, kind: type[_Reply]) -> Steps[_Reply]:
        reply = yield from self._question(message)
        if not isinstance(reply, kind):
            raise TypeError(f"{message!r} is answered by {type(reply).__name__}")
        return reply

    def _whole_reply(self, message: Message, kind: type[_Reply]) -> Steps[_Reply]:
        """Send a question; give the reply. Raises IncompleteReplyError."""
        reply = yield from self._reply(message, kind)
        requested, missing, arrived = left_out(self._library.exchanges, message, reply)
        if missing:
            raise IncompleteReplyError(requested, missing, [reply], arrived)
        return reply

    def _replies(
        self, kind: type[Message], reply: type[_Reply], items: Iterable[Any]
    ) -> Steps[list[_Reply]]:
        """Send a question that is too long for one, in parts. Raises IncompleteReplyError."""
        replies: list[_Reply] = []
        requested, missing, arrived = "", [], []
        for message in parts_of(self._library.exchanges, kind, items):
            got = yield from self._reply(message, reply)
            replies.append(got)
            field, left, came = left_out(self._library.exchanges, message, got)
            requested = field or requested
            missing += left
            arrived += came
        if missing:
            raise IncompleteReplyError(requested, missing, replies, arrived)
        return replies

    def _exchanges(
        self, kind: type[Message], items: Iterable[Any]
    ) -> Steps[list[tuple[Message, Message]]]:
        """Send a question in parts; give each with its reply, whole or not."""
        exchanged: list[tuple[Message, Message]] = []
        for message in parts_of(self._library.exchanges, kind, items):
            reply = yield from self._question(message)
            exchanged.append((message, reply))
        return exchanged

    def _next_report(self, timeout: float | None) -> Steps[Message | None]:
        """Wait for the next report; None when none comes any more, or not in time."""
        until = None if timeout is None else self._clock() + timeout
        while True:
            report = self._session.reports.take()
            if report is not None or self._closing:
                return report
            self._check()
            if until is not None and self._clock() >= until:
                return None
            yield until

    def _report(self, kind: Kinds, timeout: float, fields: Mapping[str, int]) -> Steps[Message]:
        """Wait for a report of a class with these fields."""
        wanted = ReportFilter(self._library.codec.received, kind, fields)
        began = self._clock()
        reports = self._session.reports
        began_at = reports.next_number
        since = reports.since(wanted)
        last = False
        while True:
            found = reports.find(wanted, since=since, began_at=began_at)
            if found is not None:
                return found
            if last:
                instead = reports.instead_of(wanted, since=since)
                raise NoReportError(str(wanted), self._clock() - began, instead)
            self._check()
            # One more look after the time is up: what has arrived by then has come in time.
            last = self._clock() >= began + timeout
            yield self._clock() if last else began + timeout

    # ------------------------------------------------------------------ how a line ends

    def _give_up_line(self, before: ErrorMapping) -> Callable[[], ErrorMapping] | None:
        """End what is under way on the line; return what opens it again, None if that is done.

        `before` is what carried the line when somebody decided to open it again.
        """
        if self._transport is not before and self._failure is None:
            return None
        reopen = self._transport.reopen
        if self._closing:
            raise self._closed()
        self._fail(TransportError(self._name, "the line is being opened again", "ask again"))
        return reopen

    def _take_line(self, transport: ErrorMapping) -> None:
        """Go on with the line that has been opened again."""
        self._transport = transport
        self._session.restart(self._clock())
        self._failure = None

    def _fail(self, error: TransportError) -> None:
        if self._failure is None:
            self._failure = error
            self._session.fail(error)
        self._wake()

    def _check(self) -> None:
        if self._closing:
            raise self._closed()
        if self._failure is not None:
            raise self._failure.again()

    def _closed(self) -> ClosedError:
        return ClosedError(self._name, "it has been closed", "open it again")

    # ------------------------------------------------------------------ callbacks

    def _add_callback(self, callback: Callable[[Message], object]) -> Callable[[], None]:
        """Call `callback` with every report from now on; return what ends that."""
        # Whoever registers a function twice has two registrations.
        token = object()
        self._callbacks[token] = callback

        def stop() -> None:
            # What has been ended may be ended again, and by two threads at once.
            self._callbacks.pop(token, None)

        return stop

    def _report_to_callbacks(self, report: Message) -> None:
        for callback in [*self._callbacks.values()]:
            try:
                callback(report)
            except Exception:
                logger = self._library.log()
                logger.exception("%r failed on %r", callback, report)


def _chosen_ids(given: Iterable[int], pose: Pose | None) -> tuple[int, ...]:
    """Return the ids given as an argument, each once. Raises ValueError for what can be none."""
    try:
        ids = tuple(dict.fromkeys(map(index, given)))
    except TypeError:
        raise ValueError(f"ids is {given!r}, and must be numbers, such as (1, 2)") from None
    if ids and pose is None:
        raise ValueError(f"ids is {given!r}, and nothing that is asked here takes a list of ids")
    for each in ids:
        if pose is not None and each not in pose.ids:
            low, high = pose.ids[0], pose.ids[-1]
            raise ValueError(f"ids has {each}, and a {pose.noun} is {low}..{high}")
    return ids
