"""What comes back for a request, and how it is distinguished from what comes back for another."""

from __future__ import annotations

from ..frame.errors import EncodeError
from .late_replies import Origin

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..frame.message import Message


class Unaddressed:
    """Messages without an address: there is one device, which receives and sends them all."""

    __slots__ = ()
    field: str = ""
    senders: tuple[str, ...] = ()

    def of(self, _request: Message) -> int | None:
        """Return the address that a request goes to; None where there are none."""
        return None

    def sender(self, _reply: Message) -> int | None:
        """Return the address that a reply comes from; None where there are none."""
        return None

    def silence(self, _request: Message) -> str:
        """Return the name of the address that a request goes to, if nobody answers there."""
        return ""


class Unfailing:
    """Replies that say nothing of a failure, and no message that comes instead of them."""

    __slots__ = ()
    refusal: type[Message] | None = None
    field: str = ""
    good: int = 0

    def error(self, _request: Message, _reply: Message) -> Exception | None:
        """Return the error that a reply tells of; None where it is as wanted."""
        return None


class Uncounted:
    """Replies that hold as many items as they like."""

    __slots__ = ()

    def asked(self, _request: Message) -> int | None:
        """Return how many items a request asks for; None where it does not say."""
        return None

    def fits(self, _request: Message, _reply: Message) -> bool:
        """Return whether a reply holds as many items as were asked for, or says why it does not."""
        return True


UNADDRESSED = Unaddressed()
UNCOUNTED = Uncounted()
UNFAILING = Unfailing()


class Exchange:
    """One message of the client, with its reply and its reports.

    `method` is the method of the client that sends it and `arguments` their order; `result` is the
    field of the reply that the method returns, or empty. `reply` is the message that answers it,
    None if none does; `reports` are messages that may follow it, and `acknowledged` is that of
    them which acknowledges it. `lasts` is the field that says how long its effect lasts, and how
    many units of it make a second. `echoed` pairs each requested field with the field of the reply
    that repeats it (`ids` with `items.id`), and `counted` compares how many items that holds with
    how many were asked for. `address` tells which device it goes to and comes from, `failures` what
    it means that the device refuses or fails. `counter` is the field with the running number, and
    how many numbers there are.
    """

    __slots__ = (
        "_sizes",
        "acknowledged",
        "address",
        "arguments",
        "counted",
        "counter",
        "echoed",
        "failures",
        "is_query",
        "kinds",
        "lasts",
        "method",
        "origin",
        "reply",
        "reports",
        "result",
    )

    def __init__(
        self,
        method: str,
        arguments: tuple[str, ...],
        *,
        reply: type[Message] | None = None,
        result: str = "",
        reports: tuple[type[Message], ...] = (),
        acknowledged: type[Message] | None = None,
        lasts: tuple[str, int] | None = None,
        echoed: tuple[tuple[str, str], ...] = (),
        counted: Uncounted = UNCOUNTED,
        address: Unaddressed = UNADDRESSED,
        failures: Unfailing = UNFAILING,
        counter: tuple[str, int] | None = None,
    ) -> None:
        self.method = method
        self.arguments = arguments
        self.reply = reply
        self.result = result
        self.reports = reports
        self.acknowledged = acknowledged
        self.lasts = lasts
        self.echoed = echoed
        self.counted = counted
        self.address = address
        self.failures = failures
        self.counter = counter
        # The messages that answer it, or refuse it.
        self.kinds = tuple(kind for kind in (reply, failures.refusal) if kind is not None)
        self.origin = Origin(self.kinds, None)
        # Whether its reply says anything new, so that it may be asked again. What a reply confirms,
        # and no more, would be done twice.
        self.is_query = reply is not None and not self.known.issuperset(reply.__match_args__)
        # The sizes of these, where they do not depend on the request.
        self._sizes: tuple[int, int] | None = None

    @property
    def known(self) -> set[str]:
        """The fields of a reply that repeat the request, or tell whether that was carried out."""
        counter = () if self.counter is None else self.counter[:1]
        repeated = (reported for _, reported in self.echoed)
        return {*repeated, *self.address.senders, self.failures.field, *counter}

    def check(self, request: Message) -> None:
        """Raise EncodeError if no reply has room for the answer to `request`."""
        items, most = request.SHAPE.items, self.most
        if most and items is not None and len(getattr(request, items.name)) > most:
            size = len(getattr(request, items.name))
            problem = f"{size} items are requested at once, and a reply has room for {most}"
            raise EncodeError(items.name, getattr(request, items.name), problem)

    @property
    def most(self) -> int:
        """How many items of a request one reply can repeat; 0 where it repeats no list."""
        items = None if self.reply is None else self.reply.SHAPE.items
        if items is None or not any(
            items.name == each.partition(".")[0] for _, each in self.echoed
        ):
            return 0
        return items.counts[-1]

    def answers(self, request: Message, message: Message) -> bool:
        """Return whether `message` can be the reply: it holds nothing that was not requested."""
        if type(message) not in self.kinds or not self._is_from(request, message):
            return False
        if type(message) is not self.reply:
            return True
        for requested, reported in self.echoed:
            left = column(request, requested)
            for value in column(message, reported):
                if value not in left:
                    return False
                left.remove(value)
        return self.counted.fits(request, message)

    def _is_from(self, request: Message, message: Message) -> bool:
        """Return whether a message comes from the device that was asked, or one of all of them."""
        sender = self.address.sender(message)
        if sender is None or sender == self.address.of(request):
            return True
        return bool(self.address.silence(request))

    def missing(self, request: Message, reply: Message) -> Iterator[tuple[str, int]]:
        """Yield each requested value that is not in the reply, with the field that requested it."""
        for requested, reported in self.echoed:
            there = set(column(reply, reported))
            for value in dict.fromkeys(column(request, requested)):
                if value not in there:
                    yield requested, value

    def seconds(self, request: Message) -> float:
        """Return how many seconds the effect of `request` lasts; 0.0 if it has no such field."""
        if self.lasts is None:
            return 0.0
        name, steps_per_second = self.lasts
        steps: int = getattr(request, name)
        return steps / steps_per_second

    def reply_sizes(self, request: Message) -> tuple[int, int]:
        """Return the size in bytes of the smallest and the largest frame that answers `request`.

        The smallest is that of an answer in full, where the reply repeats a list.
        """
        if self._sizes is None or self.echoed or self.counted is not UNCOUNTED:
            sizes = [size for kind in self.kinds for size in self._sizes_of(kind, request)]
            self._sizes = min(sizes, default=0), max(sizes, default=0)
        return self._sizes

    def _sizes_of(self, kind: type[Message], request: Message) -> tuple[int, int]:
        """Return the least and the largest size of an answer of a class."""
        items, lengths, size_of = kind.SHAPE.items, kind.LENGTHS, kind.FRAME.size
        least, largest = size_of(lengths[0]), size_of(lengths[-1])
        if items is None or kind is not self.reply:
            return least, largest
        count = self._count(request, items.name)
        if count is None or count not in items.counts:
            return least, largest
        size = size_of(lengths[items.counts.index(count)])
        # One that says that the request has failed may hold fewer.
        fewer = self.counted is not UNCOUNTED and self.failures.field
        return (least if fewer else size), size

    def _count(self, request: Message, listed: str) -> int | None:
        """Return how many items the list of a reply holds at most; None if that is unknown."""
        for requested, reported in self.echoed:
            if reported.partition(".")[0] == listed:
                return len(column(request, requested))
        return self.counted.asked(request)

    def reply_size(self, request: Message) -> int:
        """Return the size in bytes of the largest frame that can answer `request`."""
        return self.reply_sizes(request)[1]


def column(message: Message, path: str) -> list[int]:
    """Return the values of a field, by path: one number, or one for each element of a list.

    A field that is absent has none.
    """
    name, _, inner = path.partition(".")
    value = getattr(message, name)
    if inner:
        return [getattr(item, inner) for item in value]
    if value is None:
        return []
    return list(value) if isinstance(value, tuple) else [value]
