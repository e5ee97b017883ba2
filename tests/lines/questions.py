"""A session alone, without a client, a line and a clock: what it asks, and what it is told."""

from importlib import import_module
from typing import Any

from busservo import BatteryVoltage, BatteryVoltageRead, Message
from framewire.client.request import Request
from framewire.client.session import Session

from tests.handed import handed_by

REPLY_TIMEOUT = 0.25
# Question and reply of a battery on the wire: 4 bytes and 6, at 960 a second.
TRIP = 10 / 960
# Just before the wire can have carried them, and just after.
TOO_SOON, IN_TIME = 0.94 * TRIP, 0.96 * TRIP


def session(package: str = "busservo", **given: Any) -> Session:
    """Return a session of a library, at 9600 baud unless another rate is given."""
    usual = {"baud": 9600, "reply_timeout": REPLY_TIMEOUT, "report_limit": 16}
    return Session(handed_by(package), **(usual | given))


def ask(line: Session, now: float = 0.0, message: Message | None = None, **more: Any) -> Request:
    """Have a session ask, by default for the voltage, and return its request."""
    request = line.submit(message or BatteryVoltageRead(), **more)
    assert line.outgoing(now) == [request.message.encode()]
    line.written(request, now)
    return request


def asked(package: str, question: str) -> tuple[Session, Any, Any]:
    """Return a session whose question has just left, the question, and the library's messages."""
    kinds = import_module(f"{package}.messages")
    line = session(package, settle=0)
    return line, ask(line, 0.0, getattr(kinds, question)()), kinds


def say(line: Session, now: float, *what: Message | bytes | int) -> None:
    """Tell a session messages and bytes, all at once; a number is a voltage."""
    messages = (BatteryVoltage(each) if isinstance(each, int) else each for each in what)
    frames = (each if isinstance(each, bytes) else each.encode() for each in messages)
    line.receive(b"".join(frames), now)


def settle(line: Session) -> float:
    """Let time pass until nothing is left to be decided, and return the time then."""
    now = 0.0
    while (tick_at := line.tick_at) is not None:
        now = tick_at
        line.tick(now)
    return now


def answered(line: Session, now: float, voltage: int, after: float = IN_TIME) -> Request:
    """Send a question, with one reply alone `after` seconds later."""
    request = ask(line, now)
    say(line, now + after, voltage)
    settle(line)
    return request
