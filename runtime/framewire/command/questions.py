"""Messages that this end sends, from the name and the fields on the command line."""

from __future__ import annotations

from ..client.long_question import parts_of
from ..frame.errors import EncodeError
from .encode import message_named
from .usage_error import UsageError
from .values import fields_from_text, message_from_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..client.exchange import Exchange
    from ..client.library import Library
    from ..frame.message import Message


def exchange_named(name: str, library: Library) -> tuple[type[Message], Exchange]:
    """Return a message that this end sends, with its exchange. Raises UsageError for others."""
    kind = message_named(name, library.codec)
    exchange = library.exchanges.get(kind)
    if exchange is None:
        names = ", ".join(each.__name__ for each in library.exchanges) or "there is none"
        raise UsageError(f"{kind.__name__} is never sent from here; {names} are")
    return kind, exchange


def in_parts(name: str, words: list[str], library: Library) -> list[Message]:
    """Return the message, or several if one reply has no room for all that it requests.

    It is split as the client's own method splits it. Raises UsageError.
    """
    kind, exchange = exchange_named(name, library)
    items = kind.SHAPE.items
    if not exchange.most or items is None or kind.__match_args__ != (items.name,):
        return [message_from_text(kind, words)]
    requested = fields_from_text(kind, words)[items.name]
    if len(requested) <= exchange.most:
        return [message_from_text(kind, words)]
    try:
        return parts_of(library.exchanges, kind, requested)
    except EncodeError as error:
        raise UsageError(str(error)) from None
