"""How many items a reply holds: as many as its request asks for."""

from __future__ import annotations

from ..frame.errors import EncodeError
from .exchange import Uncounted

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..frame.message import Message


class Counted(Uncounted):
    """The list of a reply that holds as many items as a field of the request says, or holds.

    A reply of another size answers something else; unless its field `failure`, where there is one,
    has another value than the `good` one: then it says why it holds none.
    """

    __slots__ = ("_asked", "_failure", "_good", "_kind")

    def __init__(
        self, asked: str, kind: type[Message], *, failure: str = "", good: int = 0
    ) -> None:
        self._asked = asked
        self._kind = kind
        self._failure = failure
        self._good = good

    def asked(self, request: Message) -> int:
        """Return how many items a request asks for."""
        value: int | tuple[object, ...] = getattr(request, self._asked)
        return value if isinstance(value, int) else len(value)

    def fits(self, request: Message, reply: Message) -> bool:
        """Return whether a reply holds as many items as were asked for, or says why it does not."""
        items = self._kind.SHAPE.items
        if type(reply) is not self._kind or items is None:
            return True
        if self._failure and getattr(reply, self._failure) != self._good:
            return True
        return len(getattr(reply, items.name)) == self.asked(request)

    def check(self, request: Message, reply: Message) -> None:
        """Raise EncodeError for a reply of another size than was asked for."""
        items = self._kind.SHAPE.items
        if items is None or self.fits(request, reply):
            return
        held = getattr(reply, items.name)
        asked = f"{self._asked} of {type(request).__name__} asks for {self.asked(request)}"
        raise EncodeError(items.name, held, f"{asked} items, and the reply holds {len(held)}")
