"""Lines with a local echo: they return what is sent, as adapters for half-duplex wires do."""

from __future__ import annotations

from collections import deque

from ..frame.errors import DecodeError
from ..line.link_errors import EchoError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..codec.counters import LineCounters
    from .library import Library
    from .request import Request


class LocalEcho:
    """The echoes that are expected: one for every frame sent, taken out of what arrives.

    Bytes of the other end pass through: in front of an echo, behind it, and in its place.
    """

    def __init__(self) -> None:
        # What was sent and has not come back, each with its frame and its deadline.
        self._expected: deque[tuple[Request, bytes, float]] = deque()
        # The last bytes that have arrived, if they may be the start of an echo.
        self._held = b""

    @property
    def due(self) -> float | None:
        """The deadline of the next echo; None while none is expected."""
        return self._expected[0][2] if self._expected else None

    def expects(self, request: Request) -> bool:
        """Return whether the echo of a request is still to come."""
        return any(each is request for each, _, _ in self._expected)

    def sent(self, request: Request, frame: bytes, until: float) -> None:
        """Expect the echo of a frame that was sent, until a deadline."""
        self._expected.append((request, frame, until))

    def take_out(self, data: bytes) -> Iterator[tuple[bytes, Request | None, list[Request]]]:
        """Yield the bytes of the other end in front of each echo, whose it is, and whose are lost.

        Those behind the last echo come with None. Frames come back in order: if the echo of a later
        one comes, those before it are lost.
        """
        data, self._held = self._held + data, b""
        while self._expected:
            found = [
                (at, number)
                for number, (_, frame, _) in enumerate(self._expected)
                if (at := data.find(frame)) >= 0
            ]
            if not found:
                kept = max(_overlap(data, frame) for _, frame, _ in self._expected)
                self._held = data[len(data) - kept :]
                data = data[: len(data) - kept]
                break
            at, number = min(found)
            lost = [self._expected.popleft()[0] for _ in range(number)]
            request, frame, _ = self._expected.popleft()
            before, data = data[:at], data[at + len(frame) :]
            yield before, request, lost
        yield data, None, []

    def forget(self, request: Request) -> None:
        """Stop expecting the echo of a request."""
        self._expected = deque(each for each in self._expected if each[0] is not request)

    def expire(self, now: float) -> tuple[bytes, list[Request]]:
        """Return what was held back in vain, and the requests whose echo should have come."""
        lost: list[Request] = []
        while self._expected and self._expected[0][2] <= now:
            lost.append(self._expected.popleft()[0])
        held = b""
        if lost:
            held, self._held = self._held, b""
        return held, lost

    def clear(self) -> list[Request]:
        """Forget all expected echoes, and return their requests."""
        pending = [request for request, _, _ in self._expected]
        self._expected.clear()
        self._held = b""
        return pending


class EchoWatch:
    """A watch for echoes on a line that was not said to have them.

    Only a returned frame that the other end cannot send shows an echo: any other may be a report.
    """

    def __init__(self, library: Library, name: str, counters: LineCounters) -> None:
        self._decode = library.codec.decode
        self._received = library.codec.received
        self._log = library.log
        self._name = name
        self._counters = counters
        # The frame sent last, and the same if it would prove an echo, otherwise nothing.
        self._sent = self._sign = b""
        self._noise = b""

    def sent(self, frame: bytes) -> None:
        """Record that a frame has been sent."""
        self._noise = b""
        if frame == self._sent:
            return  # the same question, again and again
        self._sent = frame
        try:
            self._decode(frame, self._received)
        except DecodeError:
            self._sign = frame
        else:
            self._sign = b""

    def look_at(self, noise: bytes) -> None:
        """See whether the frame that was sent last is in the noise that has come since."""
        if not self._sign:
            return
        self._noise = (self._noise + noise)[-4 * len(self._sign) :]
        if self._sign not in self._noise:
            return
        self._noise = b""
        self._counters.echoes += 1
        if self._counters.echoes == 1:  # said once
            self._log().warning(
                "%s gives back what is sent: say so (local_echo=True, or --local-echo), or else "
                "commands that come back look like reports",
                self._name,
            )


def echo_error(name: str, happened: str, request: Request) -> EchoError:
    """Return what tells that the echo of a request is missing."""
    advice = "see whether the adapter gives back what is sent; if not, leave out local_echo"
    return EchoError(name, f"{happened} ({request.message!r})", advice)


def _overlap(data: bytes, frame: bytes) -> int:
    """Return how many of the last bytes of `data` begin `frame`; less than all of it."""
    longest = min(len(data), len(frame) - 1)
    return next((size for size in range(longest, 0, -1) if frame.startswith(data[-size:])), 0)
