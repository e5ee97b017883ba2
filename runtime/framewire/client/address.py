"""The addresses of devices that share a line: whom a message is for, and whom it is from."""

from __future__ import annotations

from .exchange import Unaddressed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Mapping

    from ..frame.message import Message


class Address(Unaddressed):
    """The field that says for which device a request is, and the same of what answers it.

    `senders` are the names that this field may have in an answer, and `silent` the addresses that
    nobody answers, by name.
    """

    __slots__ = ("_names", "field", "senders")

    def __init__(self, field: str, *senders: str, silent: Mapping[str, int] | None = None) -> None:
        self.field = field
        self.senders = senders
        self._names = {value: name for name, value in (silent or {}).items()}

    def of(self, request: Message) -> int | None:
        """Return the address that a request goes to."""
        address: int = getattr(request, self.field)
        return address

    def sender(self, reply: Message) -> int | None:
        """Return the address that a reply comes from; None where it does not say."""
        for name in self.senders:
            if name in reply.__match_args__:
                address: int = getattr(reply, name)
                return address
        return None

    def silence(self, request: Message) -> str:
        """Return the name of the address that a request goes to, if nobody answers there."""
        return self._names.get(getattr(request, self.field), "")
