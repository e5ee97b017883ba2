"""Stories of a session alone, step by step: what is asked, sent and heard, and what comes of it.

Each step is made by a function here, and told in the order in which it happens. Times are seconds;
a number that is heard is a voltage; what is asked is the voltage, unless another message is given.
"""

from collections.abc import Callable, Iterable, Mapping
from typing import Any

from busservo import BatteryVoltage, BatteryVoltageRead, Message
from framewire.client.session import Session

from tests.in_turn import in_turn
from tests.lines import questions
from tests.lines.questions import say, session

QUESTION = BatteryVoltageRead()


class Told:
    """A session in the middle of a story, and its requests so far."""

    def __init__(self, line: Session) -> None:
        self.line = line
        self.requests: list[Any] = []


Step = Callable[[Told], object]


def told(stories: Mapping[str, Iterable[Step]], **given: Any) -> Callable[[], None]:
    """Return a test that tells each of these stories, of a session made with what is given."""

    def test(name: str) -> None:
        it = Told(session(**given))
        for step in stories[name]:
            step(it)

    return in_turn("name", lambda: stories)(test)


def ask(at: float = 0.0, message: Message = QUESTION, **how: Any) -> Step:
    """Have a question sent, which must be possible then."""
    return lambda it: it.requests.append(questions.ask(it.line, at, message, **how))


def want(message: Message = QUESTION, **how: Any) -> Step:
    """Submit a message, to be sent in its time."""
    return lambda it: it.requests.append(it.line.submit(message, **how))


def send(at: float, *messages: Message) -> Step:
    """Send what may be sent then, which must be these; the port has it at once."""

    def step(it: Told) -> None:
        assert it.line.outgoing(at) == [each.encode() for each in messages], f"at {at}"
        if it.line.unwritten is not None:
            it.line.written(it.line.unwritten, at)

    return step


def hear(at: float, *what: Message | bytes | int) -> Step:
    return lambda it: say(it.line, at, *what)


def tick(*at: float) -> Step:
    def step(it: Told) -> None:
        for each in at:
            it.line.tick(each)

    return step


def cancel(place: int = -1) -> Step:
    return lambda it: it.line.cancel(it.requests[place])


def restart(at: float) -> Step:
    return lambda it: it.line.restart(at)


def settled(it: Told) -> None:
    """Let time pass until nothing is left to be decided."""
    questions.settle(it.line)


def pending(it: Told) -> None:
    """Check that the last request is not done."""
    assert not it.requests[-1].done


def replied(reply: Message | int, place: int = -1) -> Step:
    """Check what a request was answered."""

    def step(it: Told) -> None:
        request = it.requests[place]
        assert (request.done, request.error) == (True, None)
        assert request.reply == (BatteryVoltage(reply) if isinstance(reply, int) else reply)

    return step


def failed(kind: type[Exception], said: str = "", **has: Any) -> Step:
    """Check the error of the last request: its kind, a part of its text, and its attributes."""

    def step(it: Told) -> None:
        error = it.requests[-1].error
        assert isinstance(error, kind)
        assert said in str(error)
        assert {name: getattr(error, name) for name in has} == has

    return step


def counted(**counts: int) -> Step:
    """Check counters."""

    def step(it: Told) -> None:
        assert {name: getattr(it.line.counters, name) for name in counts} == counts

    return step


def reported(*messages: Message) -> Step:
    """Check the reports that were kept."""

    def step(it: Told) -> None:
        assert [it.line.reports.take() for _ in messages] == [*messages]
        assert it.line.reports.take() is None

    return step


def idle(it: Told) -> None:
    """Check that there is nothing left to be sent or awaited."""
    assert it.line.idle
