"""Send a recording, each part when its time has come, and show what comes back."""

from __future__ import annotations

import queue
import sys
import threading
import time

from ..codec.event_bytes import bytes_of
from ..codec.gap import GAP
from ..frame.pluralize import pluralize
from ..line.link_errors import TransportError
from .events import totals
from .lines import Lines
from .progress import PROGRESS_INTERVAL, Progress

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence
    from typing import TextIO

    from ..codec.noise import Noise
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message
    from ..line.transport import Transport
    from ..recording.entry import Entry

# How long the last reply may take.
_QUIET = 0.25
# How long one wait may take, so that Ctrl-C is noticed on every system.
_POLL_INTERVAL = 0.1


class Playback:
    """One replay, on a given screen."""

    def __init__(self, screen: TextIO, codec: ProtocolCodec) -> None:
        self._lines = Lines(screen, codec)
        self._progress = Progress(sys.stderr)
        self._way = codec.received
        self._decoder = codec.decoder(codec.received)
        # What the listener has received: bytes, or the error that ended it; and when.
        self._received: queue.SimpleQueue[tuple[bytes | TransportError, float]] = (
            queue.SimpleQueue()
        )
        self._over = threading.Event()
        self._last = 0.0

    def play(self, line: Transport, entries: Iterable[tuple[Entry, float]], count: int) -> None:
        """Send each of `count` entries at its time; the totals come in any case."""
        sent = size = 0
        # Reading in a thread of its own, since a read may take longer than the time up to the next
        # frame, which must not be late.
        listener = threading.Thread(target=self._listen, args=(line,), daemon=True)
        listener.start()
        began = self._last = time.monotonic()
        self._lines.begin(began)
        try:
            for entry, at in entries:
                self._wait(began + at, f"{sent} of {count} sent, the next")
                data, now = bytes_of(entry.event), time.monotonic()
                line.write(data)
                self._progress.clear()
                self._lines.show(entry.event, entry.direction, now)
                sent, size = sent + 1, size + len(data)
            line.drain(1.0)
            self._wait(time.monotonic() + _QUIET, "the last answer")
        finally:
            self._over.set()
            listener.join(1.0)
            self._progress.end()
            summary = f"{sent} of {pluralize(count, 'frame')} sent, {pluralize(size, 'byte')}"
            try:
                self._show(self._decoder.flush(), time.monotonic())
            finally:
                print(f"{summary}; came back: {totals(self._decoder.counters)}", file=sys.stderr)

    def _listen(self, line: Transport) -> None:
        while not self._over.is_set():
            try:
                data = line.read(_POLL_INTERVAL)
            except TransportError as error:
                self._received.put((error, time.monotonic()))
                return
            if data:
                self._received.put((data, time.monotonic()))

    def _wait(self, until: float, what: str) -> None:
        """Show what comes back until a time. Raises TransportError once the line is lost."""
        began = time.monotonic()
        while (left := until - time.monotonic()) > 0:
            try:
                pause = GAP if self._decoder.pending else _POLL_INTERVAL
                received, now = self._received.get(timeout=min(left, pause))
            except queue.Empty:
                now = time.monotonic()
                if self._decoder.pending and now - self._last >= GAP:
                    self._show(self._decoder.flush(), now)
                if now - began >= PROGRESS_INTERVAL:
                    self._progress.show(f"{what} in {left:.0f} s")
                continue
            if isinstance(received, TransportError):
                raise received
            self._last = now
            self._show(self._decoder.feed(received), now)

    def _show(self, events: Sequence[Message | Noise], now: float) -> None:
        for event in events:
            self._progress.clear()
            self._lines.show(event, self._way, now)
