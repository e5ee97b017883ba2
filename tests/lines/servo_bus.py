"""A second opinion, written apart: a bus of servos, whose frames are made by hand here.

Time is virtual, and every byte takes its time on the one wire that all share. It counts how often
two send at once, which would damage both on a real wire.
"""

from bisect import insort
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from busservo_simulator import VirtualClock

BAUD = 115200
ALL = 254
# Commands of the bus: a servo answers these with its number, a position and a temperature.
READ_ID, READ_TEMPERATURE, READ_POSITION = 14, 26, 28
MOVE = 1


def frame(servo: int, command: int, *parameters: int) -> bytes:
    """Return a frame as the vendor's document has it."""
    inside = bytes([servo, len(parameters) + 3, command, *parameters])
    return b"\x55\x55" + inside + bytes([~sum(inside) & 0xFF])


def frames_in(data: bytes) -> Iterator[tuple[int, int, bytes]]:
    """Yield number, command and parameters of frames back to back."""
    while data:
        assert data[:2] == b"\x55\x55"
        size = data[3] + 3
        assert ~sum(data[2 : size - 1]) & 0xFF == data[size - 1]
        yield data[2], data[4], data[5 : size - 1]
        data = data[size:]


@dataclass
class Servo:
    """A servo, each position of which is told once: no two answers are the same.

    It begins to answer after `delay` seconds, and sends its answer `copies` times, or none at all
    where it is `dead`.
    """

    number: int
    delay: float = 0.001
    dead: bool = False
    copies: int = 1
    position: int = 0
    told: list[int] = field(default_factory=list)
    moves: list[bytes] = field(default_factory=list)

    def answer(self, command: int, parameters: bytes) -> bytes:
        """Return what it answers to a command; nothing to most."""
        if command == MOVE:
            self.moves.append(parameters)
        if command == READ_POSITION:
            self.position += 1
            self.told.append(self.position % 1000 + 1000 * self.number)
            return frame(self.number, command, self.told[-1] & 0xFF, self.told[-1] >> 8)
        return frame(self.number, command, self.number) if command in _ONE_BYTE else b""


_ONE_BYTE = {READ_ID, READ_TEMPERATURE}


class ServoBus:
    """A transport with servos behind it; with `echo`, what is written comes back as well."""

    name = "servo bus"

    def __init__(
        self, *numbers: int, echo: bool = False, apart: bool = True, baud: float = BAUD
    ) -> None:
        self.timer = VirtualClock()
        self.servos = {number: Servo(number) for number in numbers}
        self.echo = echo
        # Whether a servo of a higher number takes longer, so that not all answer at once.
        self.apart = apart
        self.collisions = 0
        self.commands: list[tuple[int, int]] = []
        self._byte = 10 / baud
        self._free = 0.0
        # What is on the wire: from when to when, and the bytes that arrive at the end of it.
        self._sending: list[tuple[float, float, bytes]] = []
        self._arrived = b""
        self._readable: Callable[[], object] = int
        self.timer.when_due(lambda: self._sending[0][1] if self._sending else None)
        self.timer.when_moved(self._move)

    def clock(self) -> float:
        """Return the time."""
        return self.timer.now()

    def write(self, data: bytes) -> None:
        """Carry frames to all servos."""
        for number, command, parameters in frames_in(data):
            self.commands.append((number, command))
            told = frame(number, command, *parameters)
            heard = self._free = self._put(max(self.clock(), self._free), told, self.echo)
            for servo in self.servos.values():
                if number in (servo.number, ALL):
                    self._answer(servo, command, parameters, heard)

    def _answer(self, servo: Servo, command: int, parameters: bytes, heard: float) -> None:
        answer = servo.answer(command, parameters)
        if not answer or servo.dead:
            return
        at = heard + servo.delay * (servo.number if self.apart else 1)
        for _ in range(servo.copies):
            at = self._put(at, answer, arrives=True)

    def _put(self, at: float, data: bytes, arrives: bool) -> float:
        """Put bytes on the wire; return when the last of them has left.

        The host sends one frame after the other; a servo looks at nothing but its own time.
        """
        starts, ends = at, at + len(data) * self._byte
        self.collisions += sum(begun < ends and starts < ended for begun, ended, _ in self._sending)
        insort(self._sending, (starts, ends, data if arrives else b""), key=lambda each: each[1])
        return ends

    # ------------------------------------------------------------------ a transport

    def read(self, timeout: float) -> bytes:
        """Return what has arrived; where nothing has, time goes on until something does."""
        until = self.clock() + max(timeout, 1e-6) if timeout else self.clock()
        while not self._arrived and self.clock() < until:
            ends = [end for _, end, _ in self._sending]
            self.timer.move_to(min([until, *(end for end in ends if end > self.clock())]))
            self._move()
        data, self._arrived = self._arrived, b""
        return data

    def on_readable(self, callback: Callable[[], object]) -> None:
        """Call back once something has arrived."""
        self._readable = callback

    def drain(self, _timeout: float) -> None:
        """Do nothing: what is written is on its way."""

    def close(self) -> None:
        """Do nothing: there is nothing to give back."""

    def _move(self) -> None:
        while self._sending and self._sending[0][1] <= self.clock():
            self._arrived += self._sending.pop(0)[2]
        if self._arrived:
            self._readable()
