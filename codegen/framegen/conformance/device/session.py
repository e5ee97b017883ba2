"""A session with a device: sends what is allowed, a burst at a time, and reads the answers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.conformance.device.receiver import Receiver
from framegen.conformance.device.step import data_of, requests_of
from framegen.language.values import to_hex

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from framegen.conformance.device.permission import Permission
    from framegen.conformance.device.receiver import Received
    from framegen.conformance.device.recording import Recording
    from framegen.conformance.device.step import Burst
    from framegen.conformance.device.transport import Transport
    from framegen.model.layout import MessageLayout

# A reply that is due is waited for so many timeouts longer, to tell a late one from none.
_LATE = 4
# What comes in so many seconds before anything is sent is unsolicited.
_LISTENING = 0.25
# The line is quiet once nothing has come for so many seconds.
_QUIET = 0.05
# So long a device may go on sending by itself, in seconds, before it is not waited for any more.
_RESTLESS = 1.0


@dataclass(frozen=True, slots=True)
class Timing:
    """The time limits: `timeout` seconds for a device to respond, and the time on the wire."""

    baud: int
    bits_per_byte: int
    timeout: float

    def wire(self, size: int) -> float:
        """Return the seconds that so many bytes take on the line."""
        return size * self.bits_per_byte / self.baud

    def limits(self, burst: Burst) -> list[float]:
        """Return, by request of a burst, when its reply is due, in seconds from its beginning."""
        limits = []
        due = self.wire(len(data_of(burst)))
        for request in requests_of(burst):
            due += self.wire(request.reply_size) + self.timeout
            limits.append(due)
        return limits


@dataclass(frozen=True, slots=True)
class Transcript:
    """What was sent at once, at `at`, and all that arrived until the line was quiet again.

    `limits` are, by request, the seconds within which its reply is due. All times are seconds from
    the beginning of the run.
    """

    at: float
    burst: Burst
    limits: list[float]
    received: list[Received]


class Session:
    """A session on a transport. What the permission objects to is never written."""

    def __init__(
        self,
        transport: Transport,
        permission: Permission,
        timing: Timing,
        recording: Recording,
        clock: Callable[[], float],
    ) -> None:
        self.permission = permission
        self.timing = timing
        self._transport = transport
        self._recording = recording
        self._clock = clock
        self._began = clock()
        self._receiver = Receiver(permission.model)
        self._received: list[Received] = []
        # What a device may still hold of all that was sent.
        self._sent = b""
        self._most = permission.model.largest(permission.model.directions)

    @property
    def now(self) -> float:
        """Seconds since the beginning."""
        return self._clock() - self._began

    def objection(self, burst: Burst) -> str:
        """Return why a burst must not be sent now; empty if it may."""
        return self.permission.objection(self._sent + data_of(burst))

    def listen(self, seconds: float = _LISTENING) -> Transcript:
        """Read what a device sends unsolicited, where nothing is sent."""
        at = self.now
        self._read_until(at + seconds)
        return Transcript(at, (), [], self._end())

    def send(self, burst: Burst) -> Transcript:
        """Send a burst, and read until its replies have arrived or are given up."""
        data = data_of(burst)
        if objection := self.objection(burst):
            raise AssertionError(f"{to_hex(data)} must not be sent: {objection}")
        at, limits = self.now, self.timing.limits(burst)
        # Noted first: what cannot be noted is not sent.
        self._recording.sent(burst, at)
        if self.permission.echo:
            self._receiver.expect(data)
        self._transport.write(data)
        self._sent = (self._sent + data)[-self._most :]
        due = [request.answers for request in requests_of(burst) if request.answers]
        until = at + max(limits, default=self.timing.timeout)
        # Longer, to recognise a late reply; and a beginning of none may hold back one in time.
        self._read_until(until + _LATE * self.timing.timeout if due else until, due)
        return Transcript(at, burst, limits, self._end())

    def _read_until(self, moment: float, due: Sequence[Sequence[MessageLayout]] = ()) -> None:
        """Read until then, or until as many replies have arrived as are due."""
        while not (due and _has(due, self._received)) and (left := moment - self.now) > 0:
            if not self._receiver.holds_a_frame:
                self._read(left)
            elif not self._read(min(left, _QUIET)):
                self._note(self._receiver.flush())

    def _read(self, timeout: float) -> bool:
        """Read once, and tell whether anything arrived."""
        data = self._transport.read(timeout)
        if data:
            self._note(self._receiver.feed(data, self.now))
        return bool(data)

    def _end(self) -> list[Received]:
        """Wait until the line is quiet, and return what has arrived."""
        until = self.now + _RESTLESS
        while self._read(_QUIET) and self.now < until:
            pass
        self._note(self._receiver.flush())
        received, self._received = self._received, []
        return received

    def _note(self, received: list[Received]) -> None:
        for each in received:
            self._recording.received(each)
        self._received += received


def _has(due: Sequence[Sequence[MessageLayout]], received: list[Received]) -> bool:
    """Tell whether as many replies have arrived as are due, whatever they say."""
    answers = [message for each in due for message in each]
    return sum(each.event.message in answers for each in received) >= len(due)
