"""A second opinion, written apart: a board with numbered replies, a slow wire, and faults.

It is written from the document alone and shares no code with what it tests. It has no clock, no
thread and no port: its driver gives it the time, in seconds.

Every question gets the next number, and its reply holds nothing else: as the voltage in mV, or as
the position of every servo. So a value shows which question it answers.
"""

import heapq
import math
from collections import deque
from collections.abc import Callable, Collection
from functools import partial
from typing import NamedTuple

from tests.contract.independent.faults import Piece, Script, whole
from tests.contract.independent.firmware import (
    BATTERY,
    COMPLETED,
    POSITIONS,
    QUESTIONS,
    RUN,
    STARTED,
    STOP,
    STOPPED,
    Reader,
    battery_reply,
    positions_reply,
    report,
    well_formed,
)

BITS_PER_BYTE = 10
# Numbers go round below those that no board has to send. From 0x5500 on, a frame might begin in
# the last byte of a reply: tests that want that say from which number they begin.
NUMBERS = 20_000
# So many of each are remembered.
KEPT = 10_000


class Received(NamedTuple):
    """A frame that the board has received, and the number of the question in it, or 0."""

    at: float
    frame: bytes
    number: int


class Said(NamedTuple):
    """Bytes that the board has sent, and when the last of them reaches the host."""

    at: float
    data: bytes


class Board:
    """A board at the end of its line.

    `baud` is the pace of the line, both ways, and `thinks` the time until a reply is due. `faults`
    gives the script for the reply to a question by its number, and the first question has number
    `first`. Bytes reach the host every `latency` seconds, as those of a USB adapter do; or a frame
    at a time, if the adapter `gathers`: none is then torn by a busy machine. With `echo`, the host
    receives what it sends, as at a half-duplex adapter. Groups run for `group_seconds` each time;
    `unknown_groups` never run.
    """

    def __init__(
        self,
        *,
        baud: float = math.inf,
        thinks: float = 0.0,
        faults: Callable[[int], Script | None] | None = None,
        latency: float = 0.0,
        gathers: bool = False,
        echo: bool = False,
        group_seconds: float = 0.05,
        unknown_groups: Collection[int] = (),
        servos: Collection[int] = range(256),
        first: int = 1,
    ) -> None:
        self.faults = faults
        self.questions = first - 1
        self.received: deque[Received] = deque(maxlen=KEPT)
        self.said: deque[Said] = deque(maxlen=KEPT)
        self.reported: list[bytes] = []
        self.refused: list[bytes] = []
        # When a reply was due that a fault happened to, and when each piece of it is with the host.
        self.faulty: list[float] = []
        self.troubles: list[float] = []
        self.accepted = 0
        self._first = first
        self._seconds_per_byte = BITS_PER_BYTE / baud
        self._thinks = thinks
        self._latency = latency
        self._gathers = gathers
        self._echo = echo
        self._group_seconds = group_seconds
        self._unknown_groups = unknown_groups
        self._servos = servos
        self._reader = Reader()
        self._running: object = None
        # Bytes of the host on their way, and bytes to the host, each with when it is there.
        self._arriving: deque[tuple[float, int]] = deque()
        self._leaving: list[tuple[float, int, bytes]] = []
        self._arrives_from = self._leaves_from = -math.inf
        self._due: list[tuple[float, int, Callable[[float], None]]] = []
        self._count = 0

    # ---------------------------------------------------------------- the line

    def write(self, data: bytes, now: float) -> None:
        """Take bytes from the host, which the wire then carries one by one."""
        self._live(now)
        for byte in data:
            at = max(now, self._arrives_from) + self._seconds_per_byte
            self._arrives_from = at
            self._arriving.append((at, byte))
        self._live(now)

    def read(self, now: float) -> bytes:
        """Return the bytes that have reached the host by now."""
        self._live(now)
        pieces = []
        while self._leaving and self._leaving[0][0] <= now:
            pieces.append(heapq.heappop(self._leaving)[2])
        return b"".join(pieces)

    @property
    def next_event(self) -> float:
        """When something happens next; infinity if nothing will."""
        return min(
            self._arriving[0][0] if self._arriving else math.inf,
            self._due[0][0] if self._due else math.inf,
            self._leaving[0][0] if self._leaving else math.inf,
        )

    @property
    def last_event(self) -> float:
        """When the last of what is under way is sent, or with the host."""
        moments = [at for at, _ in self._arriving]
        moments += [at for at, *_ in self._due] + [at for at, *_ in self._leaving]
        return max(moments, default=0.0)

    @property
    def in_transit(self) -> int:
        """How many bytes of the host are still on their way."""
        return len(self._arriving)

    # ---------------------------------------------------------------- what a test can do

    def report(self, command: int, group: int = 0, times: int = 0, *, at: float) -> None:
        """Send an unsolicited report: STARTED, STOPPED or COMPLETED."""
        self.send([Piece(0.0, report(command, group, times), is_report=True)], at)

    def send(self, pieces: list[Piece], due: float, *, in_trouble: bool = False) -> None:
        """Send bytes as they are, each piece when it is due."""
        for piece in pieces:
            self._at(due + piece.after, partial(self._put, piece, in_trouble=in_trouble))

    # ---------------------------------------------------------------- what a test looks at

    def arrivals(self, data: bytes) -> list[float]:
        """Return when these bytes, sent as they are, reached the host."""
        return [said.at for said in self.said if said.data == data]

    def asked_at(self, number: int) -> float:
        """Return when a question was received; before all time if it is not remembered."""
        times = (each.at for each in reversed(self.received) if each.number == number)
        return next(times, -math.inf)

    def troubled(self, since: float, until: float) -> bool:
        """Return whether a fault happened then, or a piece of such a reply reached the host."""
        return any(since <= at <= until for at in self.troubles)

    def faulted(self, since: float, until: float) -> bool:
        """Return whether a reply was due then that a fault changed."""
        return any(since <= at <= until for at in self.faulty)

    # ---------------------------------------------------------------- how it lives

    def _at(self, moment: float, action: Callable[[float], None]) -> None:
        self._count += 1
        heapq.heappush(self._due, (moment, self._count, action))

    def _live(self, now: float) -> None:
        while self._arriving or self._due:
            arrives = self._arriving[0][0] if self._arriving else math.inf
            due = self._due[0][0] if self._due else math.inf
            if min(arrives, due) > now:
                return
            if due <= arrives:
                at, _, action = heapq.heappop(self._due)
                action(at)
            else:
                self._receive(*self._arriving.popleft())

    def _put(self, piece: Piece, at: float, *, in_trouble: bool = False) -> None:
        """Put bytes on the wire, behind those that it carries."""
        if piece.is_report:
            self.reported.append(piece.data)
        there = self._carry(piece.data[: piece.size], at) if piece.pause else at
        there = self._carry(piece.data[piece.size :], there + piece.pause)
        self.said.append(Said(there, piece.data))
        if in_trouble:
            self.troubles.append(there)

    def _carry(self, data: bytes, at: float) -> float:
        """Return when these bytes reach the host."""
        if self._seconds_per_byte and not self._gathers:
            pieces = [bytes([byte]) for byte in data]
        else:
            pieces = [data]
        there = at
        for piece in pieces:
            takes = len(piece) * self._seconds_per_byte
            self._leaves_from = max(at, self._leaves_from) + takes
            there = self._leave(self._leaves_from, piece)
        return there

    def _leave(self, at: float, data: bytes) -> float:
        """Return when these bytes reach the host."""
        if self._latency:
            at = math.ceil(at / self._latency) * self._latency
        self._count += 1
        heapq.heappush(self._leaving, (at, self._count, data))
        return at

    def _receive(self, at: float, byte: int) -> None:
        if self._echo:
            self._leave(at, bytes([byte]))
        frame = self._reader.take(byte)
        if frame is None:
            return
        if not well_formed(frame):
            self.refused.append(frame)
            return
        self.accepted += 1
        command = frame[3]
        if command in QUESTIONS:
            self.questions += 1
        self.received.append(Received(at, frame, self.questions if command in QUESTIONS else 0))
        if command == BATTERY:
            self._reply(battery_reply(self._number), at)
        elif command == POSITIONS:
            there = [servo for servo in frame[5:] if servo in self._servos]
            self._reply(positions_reply([(servo, self._number) for servo in there]), at)
        elif command == RUN and frame[4] not in self._unknown_groups:
            self._run(frame[4], int.from_bytes(frame[5:7], "little"), at)
        elif command == STOP and self._running is not None:
            self._running = None
            self.report(STOPPED, at=at + self._thinks)

    @property
    def _number(self) -> int:
        return (self.questions - self._first) % NUMBERS + self._first

    def _reply(self, reply: bytes, at: float) -> None:
        script = self.faults(self.questions) if self.faults else None
        due = at + self._thinks
        if script is not None:
            self.faulty.append(due)
            self.troubles.append(due)
        self.send((script or whole)(reply), due, in_trouble=script is not None)

    def _run(self, group: int, times: int, at: float) -> None:
        self._running = run = object()
        starts = at + self._thinks
        self.report(STARTED, group, times, at=starts)

        def end(at: float) -> None:
            if self._running is run:
                self._running = None
                self._put(Piece(0.0, report(COMPLETED, group, times), is_report=True), at)

        if times:
            self._at(starts + times * self._group_seconds, end)
