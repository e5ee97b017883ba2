"""What waits to be sent, and which of it may go now."""

from __future__ import annotations

from collections import deque

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from .reply_matcher import ReplyMatcher
    from .request import Request
    from .settling import Settling
    from .wire_time import WireTime

# How long before the line is free the next frame is handed over, so that it is never idle. More
# would be lag that nobody sees.
_AHEAD = 0.004


class RequestQueue:
    """Requests in the order in which they were submitted.

    A command goes as soon as the line is free, a question once no other is pending, no late reply
    may come that would look like its own, and the line has settled. Where many devices share the
    wire, a command waits as well while one of them may be about to answer. A newer request may take
    the place of what it undoes.
    """

    def __init__(
        self, wire_time: WireTime, settling: Settling, matcher: ReplyMatcher, latency: float
    ) -> None:
        self._wire_time = wire_time
        self._settling = settling
        self._matcher = matcher
        self._latency = latency
        self._requests: deque[Request] = deque()

    def __len__(self) -> int:
        return len(self._requests)

    def __iter__(self) -> Iterator[Request]:
        return iter(self._requests)

    def add(self, request: Request) -> list[Request]:
        """Put a request last, and return those whose place it has taken, if it is the latest."""
        replaced = self._undone_by(request) if request.latest else []
        for each in replaced:
            self._requests.remove(each)
        self._requests.append(request)
        return replaced

    def take(self, now: float) -> Request | None:
        """Take out the first that may go now, if there is one."""
        if now < self._wire_time.free_at - _AHEAD:
            return None
        request = self._next(now)
        if request is not None:
            self._requests.remove(request)
        return request

    def send_at(self, now: float) -> float | None:
        """Return when one may go; None while there is none, or only another's end can tell."""
        if not self._requests:
            return None
        free = self._wire_time.free_at - _AHEAD
        if self._next(now) is not None:
            return free
        overdue = self._matcher.overdue(now)
        if self._matcher.pending and not overdue:
            # A question waits for the one before it, whose end brings the driver back here anyway.
            return None
        late = self._matcher.late.ends()
        times = [*overdue, *late, *(self._settled_at(request) for request in self._requests)]
        settled = [at for at in times if at > now]
        return max(free, min(settled)) if settled else None

    def put_back(self, request: Request) -> None:
        """Put a request first, for a further attempt; last, where others ask other devices."""
        if request.address is None:
            self._requests.appendleft(request)
        else:
            self._requests.append(request)

    def remove(self, request: Request) -> None:
        """Take a request out."""
        self._requests.remove(request)

    def clear(self) -> list[Request]:
        """Take all requests out, and return them."""
        requests = [*self._requests]
        self._requests.clear()
        return requests

    def _next(self, now: float) -> Request | None:
        for request in self._requests:
            if not request.question:
                if request.shares_wire and self._matcher.waits_for_reply(now):
                    continue
                return request
            if not self._matcher.may_be_mistaken(request, now) and now >= self._settled_at(request):
                return request
        return None

    def _settled_at(self, request: Request) -> float:
        """Return until when a question is held back, because replies to others may come first."""
        if not request.question:
            return float("-inf")
        size = len(request.message.encode()) + request.reply_size
        return self._settling.until(self._wire_time.seconds(size) + self._latency)

    def _undone_by(self, request: Request) -> list[Request]:
        """Return the queued commands of the same class, for the same ids or fewer."""
        covered = _subjects(request)
        return [
            each
            for each in self._requests
            if each.latest
            and type(each.message) is type(request.message)
            and _subjects(each) <= covered
        ]


def _subjects(request: Request) -> frozenset[int]:
    """Return the ids in a message: its address, or the first number of each element, or of all."""
    message = request.message
    address = request.exchange.address.of(message)
    if address is not None:
        return frozenset([address])
    items = message.SHAPE.items
    if items is None:
        return frozenset(getattr(message, name) for name in message.__match_args__[:1])
    if items.element is None:
        return frozenset(getattr(message, items.name))
    return frozenset(item[0] for item in getattr(message, items.name))
