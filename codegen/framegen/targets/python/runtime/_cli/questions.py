"""What is sent from here, from its name and its fields on the command line."""

from __future__ import annotations

from .._client.exchanges import EXCHANGES
from .._client.long_question import parts_of
from .._frame.errors import EncodeError
from .encode import message_named
from .usage_error import UsageError
from .values import fields_from_text, message_from_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .._client.exchange import Exchange
    from .._frame.message import Message


def exchange_named(name: str) -> tuple[type[Message], Exchange]:
    """A message that this end sends, and what answers it. Raises UsageError for all others."""
    kind = message_named(name)
    exchange = EXCHANGES.get(kind)
    if exchange is None:
        names = ", ".join(each.__name__ for each in EXCHANGES) or "there is none"
        raise UsageError(f"{kind.__name__} is never sent from here; {names} are")
    return kind, exchange


def in_parts(name: str, words: list[str]) -> list[Message]:
    """The message; or several, where a question about a list is longer than a reply has room for.

    As the client's own method for that question does it. Raises UsageError.
    """
    kind, exchange = exchange_named(name)
    items = kind.SHAPE.items
    if not exchange.most or items is None or kind.__match_args__ != (items.name,):
        return [message_from_text(kind, words)]
    asked = fields_from_text(kind, words)[items.name]
    if len(asked) <= exchange.most:
        return [message_from_text(kind, words)]
    try:
        return parts_of(kind, asked)
    except EncodeError as error:
        raise UsageError(str(error)) from None
