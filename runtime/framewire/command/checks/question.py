"""A question that suits any device: one without fields, which changes nothing."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ...client.exchange import Exchange
    from ...client.library import Library
    from ...frame.message import Message


def harmless_question(library: Library, address: int | None = None) -> Message | None:
    """Return the first question of the protocol that has no fields; None if each has some.

    Where devices have addresses it is for the device at `address`, or for the likeliest one.
    Raises EncodeError for an address that no device has.
    """
    for kind, exchange in library.exchanges.items():
        field = exchange.address.field
        if exchange.reply is None or kind.__match_args__ != ((field,) if field else ()):
            continue
        make: Any = kind
        at = _likeliest(kind, exchange) if field and address is None else address
        question: Message = make(at) if field else make()
        return question
    return None


def address_field(library: Library) -> str:
    """Return the name of the address that the question has; empty where it has none."""
    question = harmless_question(library)
    return "" if question is None else library.exchanges[type(question)].address.field


def _likeliest(kind: type[Message], exchange: Exchange) -> int:
    """Return the address that a device has until it is given another: 1, where there is one."""
    number: Any = vars(kind)[exchange.address.field]
    return 1 if number.low <= 1 <= number.high else int(number.low)
