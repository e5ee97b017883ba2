"""A client whose calls wait in their own threads: whoever waits also reads, for all others too."""

from __future__ import annotations

import sys
import threading
import time
import weakref

from ..line.link_errors import TransportError
from ..line.transport import Transport
from .base_client import DRAIN_TIMEOUT, POLL_INTERVAL
from .leaving import LeavingClient
from .motion import Motion
from .request import Request

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import TypeVar

    import typing_extensions as typing

    from ..frame.message import Message
    from .base_client import Steps, Wait
    from .request import Run

    _Result = TypeVar("_Result")
    _Reply = TypeVar("_Reply", bound=Message)
else:
    from ..frame.typing_later import typing

# How long to wait for another thread's notification, which always comes: so that a mistake costs no
# more than this.
_LONGEST_WAIT = 0.25


class ThreadClient(LeavingClient):
    """A client of any number of threads, which take turns in reading the line."""

    def __init__(self, transport: Transport, *, background: bool, **settings: typing.Any) -> None:
        super().__init__(transport, **settings)
        # Held for every access to the session, never for a read; acquired again by a signal handler
        # that closes this in the middle of anything. Entered itself, not by one of the conditions:
        # Ctrl-C between acquiring it and returning from that would keep it for ever.
        self._lock = threading.RLock()
        # Notified whenever anything changed.
        self._changed = threading.Condition(self._lock)
        # Each request is waited for on a condition of its own: nobody wakes for another's reply.
        self._asking: list[threading.Condition] = []
        # How many wait, and so read; the listener, which reads for nobody, waits for its turn.
        self._waiters = 0
        self._idle = threading.Condition(self._lock)
        self._reading = False
        # The threads that are in the middle of a call. A signal handler may close this in such a
        # thread, and can wait for no answer then, which the interrupted call would have to read:
        # whether that call closes it instead, as it ends.
        self._calling: list[int] = []
        self._close_later = False
        self._telling = False
        self._background = background
        self._listener: threading.Thread | None = None

    # ------------------------------------------------------------------ what methods are made of

    def _move(self, message: Message, *, latest: bool) -> Motion:
        """Send a command that lasts."""
        if latest:
            return self._motion(self._submit_latest(message))
        return self._motion(self._finish(self._command(message)))

    def _motion(self, request: Request) -> Motion:
        what = request, self._session.wire_time, self._clock, self._check
        return Motion(*what, finish=self._finish)

    def _run(self, message: Message) -> Run:
        """Send a command that is acknowledged."""
        return self._finish(self._acknowledged(message))

    def _ask(self, message: Message, kind: type[_Reply]) -> _Reply:
        """Return the reply to a request, complete. Raises IncompleteReplyError."""
        return self._finish(self._whole_reply(message, kind))

    def _ask_in_parts(
        self, kind: type[Message], reply: type[_Reply], items: Iterable[typing.Any]
    ) -> list[_Reply]:
        """Return the replies to a request that is too long for one. Raises IncompleteReplyError."""
        return self._finish(self._replies(kind, reply, items))

    def _exchanged(
        self, kind: type[Message], items: Iterable[typing.Any]
    ) -> list[tuple[Message, Message]]:
        """Return the requests for a long list, each with its reply, complete or not."""
        return self._finish(self._exchanges(kind, items))

    # ------------------------------------------------------------------ waiting

    def _finish(self, steps: Steps[_Result]) -> _Result:
        """Take the steps of a call, one after the other, and wait between them."""
        caller = threading.get_ident()
        while True:
            try:
                with self._lock:
                    self._waiters += 1
                    self._calling.append(caller)
                    try:
                        results = self._take_steps(steps)
                    finally:
                        # Another waiter must read from now on.
                        self._waiters -= 1
                        self._calling.remove(caller)
                        self._hand_over()
            finally:
                if self._close_later:
                    self._close(sys.exc_info()[1])
            self._tell()
            for result in results:
                return result

    def _take_steps(self, steps: Steps[_Result]) -> list[_Result]:
        """Take steps up to the result, or until there is a report for callbacks, and no result."""
        while True:
            try:
                wait = next(steps)
            except StopIteration as end:
                return [end.value]
            self._wait_for(wait)
            if self._session.callback_queue:
                return []

    def _close(self, under_way: BaseException | None) -> None:
        """Close the line; an exception that is under way goes on."""
        raise NotImplementedError

    def _submit_latest(self, message: Message) -> Request:
        caller = threading.get_ident()
        try:
            with self._lock:
                self._calling.append(caller)
                try:
                    self._check()
                    request = self._session.submit(message, question=False, latest=True)
                    # Whoever waits for it must learn that it has been sent or replaced.
                    request.notify = self._wake
                    self._send_due()
                    self._wake()
                finally:
                    self._calling.remove(caller)
        finally:
            if self._close_later:
                self._close(sys.exc_info()[1])
        return request

    def _wake(self) -> None:
        self._changed.notify_all()

    def _wait_for(self, wait: Wait) -> None:
        """Wait until a request is done, or until something may have changed."""
        if not isinstance(wait, Request):
            self._wait(wait)
            return
        done = threading.Condition(self._lock)
        wait.notify = done.notify
        try:
            while not wait.done:
                if self._close_later:
                    self._session.refuse_questions(self._closed())
                self._wait(None, done)
        finally:
            self._session.cancel(wait)

    # ------------------------------------------------------------------ who reads

    def _hand_over(self) -> None:
        """Wake one of the waiting threads, to read for all, unless one reads already."""
        if not self._reading:
            next(iter(self._asking), self._changed).notify()

    def _wait(self, until: float | None, answered: threading.Condition | None = None) -> None:
        """Let something happen: send what is due, then read or let another thread read.

        Returns soon, whether or not anything happened. The lock is held, and released meanwhile.
        `answered` is notified when the request that is waited for is done.
        """
        if self._send_due():
            return
        now = self._clock()
        longest = _LONGEST_WAIT if self._reading else POLL_INTERVAL
        times = [now + longest, self._session.send_at(now), until]
        pause = max(0.0, min(time for time in times if time is not None) - now)
        if self._reading:
            if answered is None:
                self._changed.wait(pause)
                return
            self._asking.append(answered)
            try:
                answered.wait(pause)
            finally:
                self._asking.remove(answered)
            return
        tick_at = self._session.tick_at
        if tick_at is not None:
            pause = max(0.0, min(pause, tick_at - now))
        self._read(pause)

    def _read(self, timeout: float) -> None:
        """Read once, for everyone. What had arrived before counts before any deadline does."""
        transport, began = self._transport, self._clock()
        failure: TransportError | None = None
        data, arrived = b"", began
        # Single bytes are not worth waking up for, each by itself.
        rest = self._session.resting_until(began) - began if self._real_time else 0.0
        try:
            self._reading = True
            # Ctrl-C may come as soon as it is released.
            self._lock.release()
            if rest > 0:
                time.sleep(min(rest, timeout))
                began = self._clock()
                timeout = max(0.0, timeout - rest)
            data = transport.read(timeout)
            arrived = self._clock()
        except TransportError as error:
            failure = error
        finally:
            self._lock.acquire()
            self._reading = False
        if transport is not self._transport:
            return
        if failure is not None:
            self._fail(failure)
            return
        reports = self._session.counters.reports
        self._session.receive(data, arrived)
        self._session.tick(began)
        if self._session.counters.reports != reports:
            self._changed.notify_all()
            self._idle.notify()
        # The next request of this thread need not be waited for.
        self._send_due()

    def _send_due(self) -> bool:
        """Write what is due; return whether there was anything."""
        frames = self._session.outgoing(self._clock())
        for frame in frames:
            try:
                self._transport.write(frame)
            except TransportError as error:
                self._fail(error)
                return True
        pending = self._session.unwritten
        if pending is not None:
            self._session.written(pending, self._clock())
        if self._session.acknowledgements.unwritten:
            self._session.acknowledgements.written(self._clock())
        return bool(frames)

    # ------------------------------------------------------------------ who listens

    def _tell(self) -> None:
        """Call the callbacks for the reports that have come, unless another thread does."""
        while True:
            with self._lock:
                if self._telling or not self._session.callback_queue:
                    return
                report = self._session.callback_queue.popleft()
                self._telling = True
            try:
                self._report_to_callbacks(report)
            finally:
                with self._lock:
                    self._telling = False

    def _listen(self) -> None:
        if self._background:
            step = weakref.WeakMethod(self._listen_once)
            name = f"{self._library.package} on {self._name}"
            self._listener = threading.Thread(target=repeat, args=(step,), name=name, daemon=True)
            self._listener.start()

    def _listen_once(self) -> bool:
        """Read if nobody else does, so that reports are received and late commands sent."""
        with self._lock:
            if self._closing or self._failure is not None:
                return False
            if self._listener is not threading.current_thread():
                return False  # it has reconnected, from within a callback, and has a successor
            if self._waiters:
                self._idle.wait(POLL_INTERVAL)
            else:
                try:
                    self._wait(None)
                finally:
                    self._hand_over()
        self._tell()
        return True

    def _stop_listening(self) -> None:
        listener = self._listener
        if listener is not None and listener is not threading.current_thread():
            listener.join(DRAIN_TIMEOUT)


def repeat(step: weakref.WeakMethod[Callable[..., bool]], *arguments: object) -> None:
    """Call a method until it returns False, or until only this still refers to its object."""
    while (call := step()) is not None and call(*arguments):
        del call
