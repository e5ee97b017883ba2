"""What a device remembers: fields that a command sets, and that the reply to another holds."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..frame.lists import List

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ..client.exchange import Exchange
    from ..frame.message import Message

_WORD = re.compile("[A-Z]+(?![a-z])|[A-Z]?[a-z]+|[0-9]+")
# Of words such as Prepare and Prepared, as much is compared.
_STEM = 5


@dataclass(frozen=True, slots=True)
class Register:
    """A field that a command sets by the name `source`, and that a reply holds by its `name`.

    `chosen_by` are the fields of both requests that say which of several is meant. `key` is the
    field of an element that does so in a list, whose elements are remembered one by one.
    """

    reply: type[Message]
    name: str
    source: str
    chosen_by: tuple[str, ...]
    key: str = ""


class Registers:
    """The values of all registers of a library, as they were set; of each device by its address."""

    def __init__(self, exchanges: Mapping[type[Message], Exchange]) -> None:
        self._exchanges = exchanges
        self._set_by: dict[type[Message], list[Register]] = {}
        self._read_by: dict[type[Message], list[Register]] = {}
        for query, exchange in exchanges.items():
            for kind, register in _registers(query, exchange, exchanges):
                self._set_by.setdefault(kind, []).append(register)
                self._read_by.setdefault(query, []).append(register)
        # By address. What was set at all of them, or has no address, is under None.
        self._held: dict[tuple[object, ...], dict[int | None, Any]] = {}

    def clear(self) -> None:
        """Forget all values."""
        self._held.clear()

    def store(self, request: Message) -> None:
        """Remember what a message sets."""
        address = self._address(request)
        for register in self._set_by.get(type(request), ()):
            value = request.to_dict()[register.source]
            rows = {row[register.key]: row for row in value} if register.key else {None: value}
            for key, each in rows.items():
                held = self._held.setdefault((*_which(register, request), key), {})
                if address is None:
                    held.clear()
                held[address] = each

    def load(self, request: Message, *, key: int | None = None) -> dict[str, Any]:
        """Return the fields of the reply that were set, with `key` the elements with this key."""
        address = self._address(request)
        found: dict[str, Any] = {}
        for register in self._read_by.get(type(request), ()):
            held = self._held.get((*_which(register, request), key), {})
            if address in held or None in held:
                found[register.name] = held.get(address, held.get(None))
        return found

    def _address(self, request: Message) -> int | None:
        address = self._exchanges[type(request)].address
        return None if address.silence(request) else address.of(request)


def _which(register: Register, request: Message) -> tuple[object, ...]:
    chosen = (getattr(request, name) for name in register.chosen_by)
    return (register.reply, register.name, *chosen)


def _registers(
    query: type[Message], exchange: Exchange, exchanges: Mapping[type[Message], Exchange]
) -> Iterator[tuple[type[Message], Register]]:
    """Yield what sets each field of the reply to a query: the commands named most like these."""
    reply = exchange.reply
    if reply is None:
        return
    paths = (path.partition(".") for _, path in exchange.echoed)
    keys = {name: inner for name, _, inner in paths}
    apart = {exchange.address.field, *(exchange.counter or ())[:1]}
    for name in reply.__match_args__:
        if name in exchange.known or name in query.__match_args__:
            continue
        key = keys.get(name, "")
        sources = {kind: _source(kind, reply, name, key) for kind in exchanges if kind is not query}
        likeness = {
            kind: _likeness(kind, query, reply) for kind, source in sources.items() if source
        }
        best = max(likeness.values(), default=(0, 0))
        for kind, each in likeness.items():
            chosen = {*kind.__match_args__} & {*query.__match_args__} - apart
            # Several that have but a name of a field in common are of several things.
            if each == best and (best[0] or chosen or len(likeness) == 1):
                yield kind, Register(reply, name, sources[kind], tuple(sorted(chosen)), key)


def _source(kind: type[Message], reply: type[Message], name: str, key: str) -> str:
    """Return the name of what a command has of the same form; "" where it has none.

    A list of elements with a key may be called otherwise.
    """
    form = _form(reply, name)
    names = kind.__match_args__ if key else [each for each in kind.__match_args__ if each == name]
    return next((each for each in names if _form(kind, each) == form), "")


def _words(kind: type[Message]) -> set[str]:
    return {word[:_STEM].lower() for word in _WORD.findall(kind.__name__)}


def _likeness(kind: type[Message], *others: type[Message]) -> tuple[int, int]:
    """Return how many words a name shares with others, and how few it has besides."""
    words, among = _words(kind), {word for each in others for word in _words(each)}
    return len(words & among), -len(words - among)


def _form(kind: type[Message], name: str) -> tuple[object, ...]:
    """Return what two fields have in common where values of one are values of the other."""
    field: Any = getattr(kind, name)
    field = field.there
    if isinstance(field, List):
        return (List, *((each.name, type(each), each.unit) for each in field.fields))
    return type(field), getattr(field, "unit", "")
