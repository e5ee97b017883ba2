"""A request about a long list: the requests that it takes, and what a reply leaves out."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Any, TypeAlias

    from ..frame.message import Message
    from .exchange import Exchange

    Exchanges: TypeAlias = Mapping[type[Message], Exchange]


def parts_of(exchanges: Exchanges, kind: type[Message], items: Iterable[Any]) -> list[Message]:
    """Return a request about a list as several, each as long as a reply has room for.

    Raises EncodeError, which names the place in the whole list.
    """
    (name,) = kind.__match_args__
    most = exchanges[kind].most
    listed = kind.SHAPE.items
    whole = None if listed is None else listed.listed(items)
    # A value that is no list, or an empty one, is for the message to refuse.
    if not whole or listed is None:
        return [kind(**{name: items})]
    for position, item in enumerate(whole):
        listed.checked_one(item, position)
    return [kind(**{name: whole[at : at + most]}) for at in range(0, len(whole), most)]


def left_out(
    exchanges: Exchanges, request: Message, reply: Message
) -> tuple[str, list[int], list[Any]]:
    """Return the field that a reply answers in part, what is missing in it, and what is there."""
    found = list(exchanges[type(request)].missing(request, reply))
    items = reply.SHAPE.items
    arrived = [] if items is None else list(getattr(reply, items.name))
    requested = found[0][0] if found else ""
    return requested, [value for _, value in found], arrived
