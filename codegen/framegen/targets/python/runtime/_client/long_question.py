"""A question about a list: the requests that it takes, and what a reply to one leaves out."""

from __future__ import annotations

from .._frame.items import as_tuple
from .exchanges import EXCHANGES

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any

    from .._frame.message import Message


def parts_of(kind: type[Message], items: Iterable[Any]) -> list[Message]:
    """A question about a list, as several, each about as much as a reply has room for.

    Raises EncodeError, which names the place in the whole list.
    """
    (name,) = kind.__match_args__
    most = EXCHANGES[kind].most
    whole = as_tuple(items)
    # What is no list, or is empty, is for the message to refuse.
    if not whole or kind.SHAPE.items is None:
        return [kind(**{name: items})]
    for position, item in enumerate(whole):
        kind.SHAPE.items.checked_one(item, position)
    return [kind(**{name: whole[at : at + most]}) for at in range(0, len(whole), most)]


def left_out(request: Message, reply: Message) -> tuple[str, list[int], list[Any]]:
    """What a reply leaves out: the field that asked for it, what is missing, and what is there."""
    found = list(EXCHANGES[type(request)].missing(request, reply))
    items = reply.SHAPE.items
    arrived = [] if items is None else list(getattr(reply, items.name))
    asked = found[0][0] if found else ""
    return asked, [value for _, value in found], arrived
