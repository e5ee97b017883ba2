"""One message on its way to the device, and its result."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum

from ..frame.errors import EncodeError
from ..frame.message import Message
from .exchange import UNADDRESSED
from .late_replies import Origin

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .exchange import Exchange


# No reply has more time than one of so many bytes before it has begun to come.
_USUAL_SIZE = 1024


class Sent:
    """A command that has been handed to the line.

    `delay` is how many seconds later its first byte is on the wire, the frames before it taking
    their time, and `duration` how many seconds it takes from there to its last byte.
    """

    __slots__ = ("delay", "duration", "message")

    def __init__(self, message: Message, delay: float, duration: float) -> None:
        self.message = message
        self.delay = delay
        self.duration = duration

    def __repr__(self) -> str:
        name, when = type(self).__name__, f"delay={self.delay:.4f}, duration={self.duration:.4f}"
        return f"{name}({self.message!r}, {when})"


class Run(Sent):
    """A command that has been handed to the line, and whether its receiver has accepted it.

    `started` is True once the report has come that acknowledges it, with the same values. It is
    False if none came in the time of a reply, though others have come over this line before: the
    command was ignored. It is None while neither is known; on a line over which no such report has
    ever come, that is for ever.

    It changes when the line is read: by a client that listens in the background, or while a call
    waits. The report does not name its command: another one with the same values has the same.
    """

    __slots__ = ("started",)

    started: bool | None

    def __repr__(self) -> str:
        return f"{super().__repr__()[:-1]}, started={self.started})"


class State(str, Enum):
    """How far a request has got."""

    WAITING = "waits to be sent"
    PENDING = "was sent; its reply is to come, or its echo"
    HELD = "was sent; a reply has come that may not be its own, and is held"
    DONE = "is over: sent, answered, or given up"


class Step(str, Enum):
    """What happens to a request."""

    SEND = "its frame is handed over"
    HOLD = "a reply comes that may be its own"
    DROP = "the held reply turns out to be meant for another, or may be"
    RETRY = "no reply came in time, or only such, and it may be sent once more"
    FINISH = "it is sent and nothing answers it; answered; replaced; failed; or taken back"


# What may happen to a request, and what it then is. Nothing else can happen.
STATES: dict[State, dict[Step, State]] = {
    State.WAITING: {Step.SEND: State.PENDING, Step.FINISH: State.DONE},
    State.PENDING: {
        Step.HOLD: State.HELD,
        Step.RETRY: State.WAITING,
        Step.FINISH: State.DONE,
    },
    State.HELD: {
        Step.HOLD: State.HELD,  # another reply takes its place, or makes both doubtful
        Step.DROP: State.PENDING,
        Step.FINISH: State.DONE,
    },
    State.DONE: {},
}


class Request:
    """A message that a session is to send. Once `done`, it has `sent`, a `reply` or an `error`."""

    __slots__ = (
        "address",
        "after_lost",
        "answered_by",
        "attempts",
        "before",
        "deadline",
        "doubted",
        "doubts",
        "echo_due",
        "error",
        "exchange",
        "gathered",
        "held",
        "is_first",
        "latest",
        "left_at",
        "left_soonest",
        "message",
        "notify",
        "owed",
        "question",
        "reply",
        "reply_least",
        "reply_room",
        "reply_size",
        "retries",
        "rivals",
        "sent",
        "sent_at",
        "state",
        "within",
        "written",
    )

    def __init__(
        self,
        message: Message,
        exchange: Exchange,
        *,
        retries: int = 0,
        latest: bool = False,
        within: float | None = None,
    ) -> None:
        self.message = message
        self.exchange = exchange
        # Whether anybody answers it; for how many seconds the replies of all who do are gathered.
        self.question = exchange.reply is not None
        self.within = within
        # The device that it is for, None for the only one or all; and what may answer it.
        self.address: int | None = None
        self.answered_by = exchange.origin
        if exchange.address is not UNADDRESSED:
            silent = bool(exchange.address.silence(message))
            self.question = self.question and (not silent or bool(within))
            self.address = None if silent else exchange.address.of(message)
            self.answered_by = Origin(exchange.kinds, self.address)
        # How many bytes its reply can have at most and at the least; 0 if there is none. One that
        # could be longer still gets its time once it has begun to come.
        least, largest = exchange.reply_sizes(message) if self.question else (0, 0)
        self.reply_least, self.reply_room = least, largest
        self.reply_size = min(largest, _USUAL_SIZE)
        self.retries = retries
        # Whether a newer one of its kind replaces it.
        self.latest = latest
        self.state = State.WAITING
        # How often it was sent, and how many of the replies to that may still come.
        self.attempts = self.owed = 0
        # Whether the port is known to have the frame of the latest attempt.
        self.written = False
        self.sent: Sent | None = None
        self.reply: Message | None = None
        self.error: Exception | None = None
        # The reply to it that has come last, and when, until it is believed or not.
        self.held: tuple[Message, float] | None = None
        # The replies before that which differ from it, and are as good; and how often there were.
        self.rivals: list[Message] = []
        self.doubts = 0
        self.gathered: list[Message] = []
        # When it was handed over first, when the last byte of it has left, and its deadline.
        self.sent_at = self.left_at = self.deadline = 0.0
        # When the last byte of the first attempt can have left at the soonest.
        self.left_soonest = 0.0
        # Whether a reply came that is impossible; whether the reply to an earlier one, which never
        # came, may come yet; and what had been counted before it was sent.
        self.doubted = self.after_lost = False
        # Whether its echo is still to come, on a line that has given back others: no reply comes
        # before that.
        self.echo_due = False
        # Whether its device was never asked for this before.
        self.is_first = False
        self.before: tuple[int, int, int] = (0, 0, 0)
        # A function to call once it is done.
        self.notify: Callable[[], None] | None = None

    @property
    def shares_wire(self) -> bool:
        """Whether devices with addresses share the wire that it goes over."""
        return self.exchange.address is not UNADDRESSED

    @property
    def done(self) -> bool:
        """Whether it is over."""
        return self.state is State.DONE

    def take(self, step: Step) -> None:
        """Record what has happened to it. Raises KeyError for what cannot happen in its state."""
        self.state = STATES[self.state][step]

    def finish(
        self,
        *,
        sent: Sent | None = None,
        reply: Message | None = None,
        error: Exception | None = None,
    ) -> None:
        """Set its result, and mark it as done."""
        self.sent = sent
        self.reply = reply
        self.error = error
        # Last, for other threads that look at it.
        self.take(Step.FINISH)
        if self.notify is not None:
            self.notify()


def check_room(message: Message, largest_frame: int | None) -> None:
    """Raise EncodeError for a frame of more bytes than `largest_frame`; None allows any."""
    size = len(message.encode())
    if largest_frame is None or size <= largest_frame:
        return
    why = f"the frame has {size} bytes, and this line carries {largest_frame} at once"
    items = message.SHAPE.items
    if items is None:
        raise EncodeError(type(message).__name__, message, why)
    lengths = zip(items.counts, message.LENGTHS, strict=True)
    sizes = ((n, message.FRAME.size(length)) for n, length in lengths)
    most = max((n for n, needed in sizes if needed <= largest_frame), default=0)
    given = getattr(message, items.name)
    raise EncodeError(items.name, given, f"{why}: room for {most} of {len(given)}")
