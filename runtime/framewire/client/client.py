"""The client for threads: its calls return once they are done."""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from os import PathLike
from types import TracebackType

from ..frame.message import Message
from ..line.link_errors import TransportError
from ..line.transport import Transport
from .base_client import DRAIN_TIMEOUT, REPLY_TIMEOUT, REPORT_LIMIT
from .limits import Allowed
from .report_filter import Kinds
from .request import Sent
from .thread_client import ThreadClient

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TypeVar, overload

    import typing_extensions as typing

    _Reply = TypeVar("_Reply", bound=Message)
    _Second = TypeVar("_Second", bound=Message)
    _Third = TypeVar("_Third", bound=Message)
else:
    from ..frame.typing_later import typing


class Client(ThreadClient):
    """A client that sends messages over a transport, matches replies, and keeps reports.

    Safe to share between threads. Nothing blocks for ever: every call ends with its result, or with
    an error, in a time that its arguments and `reply_timeout` bound. Better used in a `with`;
    `close` waits until the last byte is out. A client that is dropped without `close` is closed
    with a ResourceWarning.

    `transport` is anything with the methods of Transport. `baud` is the rate that deadlines and
    pacing are calculated from, without one that of the protocol (math.inf for a line that takes no
    time), `reply_timeout` the seconds that a reply may take beyond its time on the wire, `retries`
    how often a request without a reply is sent again, `trace` a file that every frame is recorded
    in, for `recordings` and `decode` to read (an existing recording is never overwritten:
    FileExistsError), `report_limit` how many reports are kept, `limits` the lowest and the highest
    value that is sent in fields that have limits, "usual" for what the protocol says and None for
    any; a mapping of ids to these gives each its own, and the usual ones to those that it does not
    name. `ids` are those that positions are read of where a call names none. With `background`, a
    thread listens while nobody waits; without, only calls read the line, and `clock` may be of any
    kind.

    `on_exit` says what `close`, and so the end of the `with`, does with those that this client has
    moved and with `ids`, if the protocol has positions: `"hold"` asks where they are and commands
    just that, so that nothing moves on; the verb that lets go of them (else `"release"`) does so.
    Those released last are left alone. None (the default) leaves all of them to themselves.

    `local_echo` says that the line returns what is sent, as half-duplex adapters do, and None that
    it does what the protocol says: the echo is then expected, compared and dropped, and EchoError
    raised if it does not come. `settle` is for how many seconds after opening no request is sent,
    so that no reply to an earlier program is taken for ours: None for one reply time, if the first
    message is a request or bytes came before it; 0 for not at all.
    """

    def __init__(
        self,
        transport: Transport,
        *,
        baud: float | None = None,
        reply_timeout: float = REPLY_TIMEOUT,
        retries: int = 0,
        trace: str | PathLike[str] | None = None,
        report_limit: int = REPORT_LIMIT,
        limits: Allowed | str = "usual",
        ids: Iterable[int] = (),
        on_exit: str | None = None,
        background: bool = True,
        clock: Callable[[], float] = time.monotonic,
        local_echo: bool | None = None,
        settle: float | None = None,
    ) -> None:
        super().__init__(
            transport,
            baud=baud,
            reply_timeout=reply_timeout,
            retries=retries,
            trace=trace,
            report_limit=report_limit,
            limits=limits,
            ids=ids,
            on_exit=on_exit,
            background=background,
            clock=clock,
            local_echo=local_echo,
            settle=settle,
        )
        # Held while the line is reopened: there is one port, so one thread does it for all.
        self._reopening = threading.Lock()
        # Which thread closes it, and whether that has been done.
        self._closer: threading.Thread | None = None
        self._closed_now = threading.Event()
        self._listen()

    @classmethod
    def at_port(
        cls,
        port: str,
        *,
        baud: float | None = None,
        exclusive: bool = True,
        reply_timeout: float = REPLY_TIMEOUT,
        retries: int = 0,
        trace: str | PathLike[str] | None = None,
        report_limit: int = REPORT_LIMIT,
        limits: Allowed | str = "usual",
        ids: Iterable[int] = (),
        on_exit: str | None = None,
        local_echo: bool | None = None,
        settle: float | None = None,
    ) -> typing.Self:
        """Open the port of a device, to be used in a `with`.

        `port` is a name or a URL that pyserial knows: `/dev/ttyUSB0`, `COM7`, `hwgrep://CH340`,
        `socket://host:port`, `rfc2217://host:port`, `loop://`; `hid://` is a USB HID device, which
        needs the extra `hid`, and has not been tried on hardware yet. With `exclusive`, no other
        program can have the port meanwhile. The other arguments are those of the client. Raises
        TransportError, which names the port, what happened and what to do.
        """
        transport = cls._library.open_transport(port, baud=baud, exclusive=exclusive)
        try:
            return cls(
                transport,
                baud=baud,
                reply_timeout=reply_timeout,
                retries=retries,
                trace=trace,
                report_limit=report_limit,
                limits=limits,
                ids=ids,
                on_exit=on_exit,
                local_echo=local_echo,
                settle=settle,
            )
        except BaseException:
            transport.close()
            raise

    def __enter__(self) -> typing.Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._close(error)

    def send(self, message: Message) -> Sent:
        """Send a command, as soon as the frames before it have left: no lag builds up unseen.

        Returns when it has been handed over; `delay` of the result is when it will be on the wire.
        The result is a Motion for a command that lasts, and a Run for one that is acknowledged.
        Raises LimitError for values outside the limits, and TransportError.
        """
        return self._sent(self._finish(self._command(message)))

    def request(self, message: Message, *, retries: int | None = None) -> Message:
        """Send a request and return the reply, which may hold less than was requested.

        Raises NoReplyError where none came in time, and TransportError.
        """
        return self._finish(self._question(message, retries))

    def reports(self, timeout: float | None = None) -> Iterator[Message]:
        """Yield the reports as they come, those kept so far first; each goes to one iterator.

        The iterator ends when none has come for `timeout` seconds; without one, when this is
        closed. Reports that nobody takes are kept up to the limit; then the oldest are dropped, and
        counted in `counters.lost_reports`. Raises TransportError once the line is lost.
        """
        while (report := self._finish(self._next_report(timeout))) is not None:
            yield report

    def on_report(self, callback: Callable[[Message], object]) -> Callable[[], None]:
        """Call `callback` with every report from now on; return a function that ends that.

        It is called in order, one at a time, in whichever thread has read the report, and may use
        this client. Its exceptions are logged, and do not reach anybody else. As many reports as
        are kept wait for a callback that is slow; then the oldest of them are dropped.
        """
        return self._add_callback(callback)

    if TYPE_CHECKING:

        @overload
        def wait_for(self, kind: type[_Reply], *, timeout: float, **fields: int) -> _Reply: ...

        @overload
        def wait_for(
            self, kind: tuple[type[_Reply]], *, timeout: float, **fields: int
        ) -> _Reply: ...

        @overload
        def wait_for(
            self, kind: tuple[type[_Reply], type[_Second]], *, timeout: float, **fields: int
        ) -> _Reply | _Second: ...

        @overload
        def wait_for(
            self,
            kind: tuple[type[_Reply], type[_Second], type[_Third]],
            *,
            timeout: float,
            **fields: int,
        ) -> _Reply | _Second | _Third: ...

        @overload
        def wait_for(self, kind: Kinds, *, timeout: float, **fields: int) -> Message: ...

    def wait_for(self, kind: Kinds, *, timeout: float, **fields: int) -> Message:
        """Wait for a report of a class, with these field values, and return it.

        `kind` may be a tuple of classes: the first report of any of them is returned, and a field
        that a class lacks is not compared.

        A report that has already come counts, if it came after the latest command that causes such
        reports (with these values, if any) and satisfied no earlier wait. It remains available to
        reports(). Raises NoReportError after `timeout` seconds, which says what came instead, and
        TransportError.
        """
        return self._finish(self._report(kind, timeout, fields))

    def close(self) -> None:
        """Send what still waits to be sent, wait until the last byte is out, and close the line.

        Requests of other threads end with ClosedError. May be called again, and by several threads
        at once: each of them returns once the line is closed.

        What `on_exit` asks for comes after all that is sent, within two seconds. Raises
        NotHeldError, once the line is closed, for those that were not reached; while another
        exception is being handled, that is logged instead. In a signal handler that has interrupted
        a call of this client, what `on_exit` asks for is done, and the line closed, as that call
        ends.
        """
        self._close(sys.exc_info()[1])

    def _close(self, under_way: BaseException | None) -> None:
        with self._lock:
            closer, self._closing = self._closer, True
            if closer is None:
                if self._to_leave() and threading.get_ident() in self._calling:
                    self._close_later = True
                    return
                self._closer = threading.current_thread()
        if closer is not None:
            # Whoever closes waits for the listener, and no thread can wait for itself.
            if threading.current_thread() not in (closer, self._listener):
                self._closed_now.wait()
            return
        try:
            self._end()
        except BaseException as error:
            # A second Ctrl-C: the line is closed, and whoever is left over is named.
            self._tell_left(error)
            raise
        finally:
            self._closed_now.set()
        self._tell_left(under_way)

    def reconnect(self) -> None:
        """Open the same port again after the line was lost; all that was in progress has failed.

        Reports, callbacks and counters are kept. If several threads call it at the same time, it is
        done once. A transport of your own needs a method `reopen()`, which returns the next one.
        Raises TransportError if that fails, and may then be called again.
        """
        before = self._transport
        with self._reopening:
            with self._lock:
                reopen = self._give_up_line(before)
            if reopen is None:
                return
            self._transport.close()
            self._stop_listening()
            try:
                transport = reopen()
            except TransportError as error:
                self._failure = error
                raise
            with self._lock:
                if self._closing:
                    transport.close()
                    raise self._closed()
                self._take_line(transport)
            self._listen()

    def _end(self) -> None:
        try:
            with self._lock:
                self._session.refuse_questions(self._closed())
                self._changed.notify_all()
                self._drain()
                for wait in self._leave():
                    self._wait_for(wait)
                self._drain()
                left = max(0.0, self._session.wire_time.free_at - self._clock())
            if self._failure is None:
                self._transport.drain(min(left, DRAIN_TIMEOUT) + DRAIN_TIMEOUT)
        except TransportError as error:
            self._library.log().debug("%s could not be drained: %s", self._name, error)
        finally:
            # Whatever interrupts the wait, the port is closed.
            self._transport.close()
            self._stop_listening()
            # A reconnection in progress finds the client closed, and closes the port.
            if self._reopening.acquire(timeout=DRAIN_TIMEOUT):
                self._reopening.release()
            with self._lock:
                self._session.fail(self._closed())
                self._changed.notify_all()
            self._trace.close()

    def _drain(self) -> None:
        """Send all commands that wait, and let their time on the wire pass."""
        until = self._clock() + DRAIN_TIMEOUT
        while self._failure is None:
            # What is due goes first, even if the machine has paused for longer than that.
            self._send_due()
            now = self._clock()
            free_at = self._session.wire_time.free_at
            sent = self._session.idle and now >= free_at
            if sent or now >= max(until, free_at + DRAIN_TIMEOUT):
                return
            self._wait(None if not self._session.idle else free_at)
