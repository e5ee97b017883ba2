"""Errors that a device reports: it refuses what was sent, or fails to carry it out."""

from __future__ import annotations

from ..frame.errors import ProtocolError
from .exchange import Unfailing

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from ..frame.message import Message


class RefusedError(ProtocolError):
    """The device has refused a request. `request` is that, and `refusal` the message that says so.

    `named` is what the refusal says, as far as its values have names.
    """

    def __init__(self, request: Message, refusal: Message) -> None:
        super().__init__(request, refusal)
        self.request = request
        self.refusal = refusal
        self.named = tuple(_names_in(refusal))

    def __str__(self) -> str:
        return f"{self.request!r} was refused: {self.refusal!r}{_in_brackets(self.named)}"


class FailureError(ProtocolError):
    """The device has answered that something is wrong. `reply` is the message that says so.

    `request` is what was sent, `field` the field of the reply that says so, and `named` what its
    value means, as far as that has a name.
    """

    def __init__(
        self, request: Message, reply: Message, field: str, named: tuple[str, ...] = ()
    ) -> None:
        super().__init__(request, reply, field, named)
        self.request = request
        self.reply = reply
        self.field = field
        self.named = named

    def __str__(self) -> str:
        value = getattr(self.reply, self.field)
        failed = f"{self.request!r} has failed: {self.field} is {value}"
        return f"{failed}{_in_brackets(self.named)}"


class Failures(Unfailing):
    """How the device says that it refuses or fails.

    `refusal` is the class of messages that come instead of the reply. `field` is the field of the
    reply that has another value than the `good` one after a failure; `names` are its values, and
    `bits` the masks of its bits, each by name.
    """

    __slots__ = ("_bits", "_names", "field", "good", "refusal")

    def __init__(
        self,
        *,
        refusal: type[Message] | None = None,
        field: str = "",
        good: int = 0,
        names: Mapping[str, int] | None = None,
        bits: Mapping[str, int] | None = None,
    ) -> None:
        self.refusal = refusal
        self.field = field
        self.good = good
        self._names = names or {}
        self._bits = bits or {}

    def error(self, request: Message, reply: Message) -> Exception | None:
        """Return the error that a reply tells of; None where it is as wanted."""
        if type(reply) is self.refusal:
            return RefusedError(request, reply)
        value = getattr(reply, self.field) if self.field else self.good
        if value == self.good:
            return None
        return FailureError(request, reply, self.field, self._meaning(value))

    def _meaning(self, value: int) -> tuple[str, ...]:
        named = [name for name, each in self._names.items() if each == value]
        return tuple(named or (name for name, mask in self._bits.items() if value & mask))


def _names_in(message: Message) -> Iterator[str]:
    """Yield the names that the values of a message have."""
    for field in message.__match_args__:
        names: Mapping[str, int] = getattr(vars(type(message))[field], "names", {})
        value = getattr(message, field)
        yield from (name for name, each in names.items() if each == value)


def _in_brackets(named: Iterable[str]) -> str:
    words = ", ".join(named)
    return f" ({words})" if words else ""
