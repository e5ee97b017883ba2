"""What becomes of a question and its reply: parts to ask in, and what a reply leaves out."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .exchanges import EXCHANGES, RECEIVED
from .fields import as_tuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Any

    from .message import Message


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
        kind.SHAPE.items.checked_one(item, f"{name}[{position}]")
    return [kind(**{name: whole[at : at + most]}) for at in range(0, len(whole), most)]


def lacking(request: Message, reply: Message) -> tuple[str, list[int], list[Any]]:
    """What a reply leaves out: the field that asked for it, what is missing, and what is there."""
    found = list(EXCHANGES[type(request)].missing(request, reply))
    items = reply.SHAPE.items
    arrived = [] if items is None else list(getattr(reply, items.name))
    asked = found[0][0] if found else ""
    return asked, [value for _, value in found], arrived


def report_wanted(kind: type[Message], fields: Mapping[str, int]) -> str:
    """A report that is waited for, in words. Raises TypeError for one that can never come."""
    if kind.DIRECTION is not RECEIVED:
        raise TypeError(f"{kind.__name__} is no message that comes to this end")
    unknown = [name for name in fields if name not in kind.__match_args__]
    if unknown:
        known = ", ".join(kind.__match_args__) or "none"
        raise TypeError(f"{kind.__name__} has no field {unknown[0]!r}; it has {known}")
    return f"{kind.__name__}({', '.join(f'{name}={value}' for name, value in fields.items())})"
