"""The requests of a run: each query with its examples, each size of list, repeated and in pairs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.cases.valid import item_at, values_at
from framegen.conformance.device.step import Request, Step
from framegen.model.codec import encode
from framegen.model.slots import Items, Number

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.conformance.device.permission import Permission
    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model
    from framegen.model.slots import Field


# No list is asked about that has more elements, whatever a frame has room for.
_MOST_ELEMENTS = 255


def query_steps(permission: Permission) -> Iterator[Step]:
    """Yield a step for every way of sending each query."""
    queries = requests(permission)
    for request in queries:
        yield Step(_titled(request), ((request,),))
    firsts = list({request.message.name: request for request in reversed(queries)}.values())[::-1]
    for request in firsts:
        yield Step(f"{_titled(request)}, twice in a row", ((request,), (request,)))
    for one, other in () if permission.is_shared else _pairs(firsts):
        title = f"{one.message.name} and {other.message.name} at once"
        yield Step(title, ((one, other),))


def command_steps(permission: Permission, after: Request | None) -> Iterator[Step]:
    """Yield the examples of the allowed commands, each followed by a query."""
    for request in commands(permission):
        bursts = ((request,),) if after is None else ((request,), (after,))
        behind = "" if after is None else f", then {after.message.name}"
        yield Step(f"{_titled(request)}{behind}", bursts)


def requests(permission: Permission) -> list[Request]:
    """Return every query that is sent: those of the examples, and one for each size of list."""
    found: dict[bytes, Request] = {}
    for exchange in _of(permission.model, permission.queries):
        for request in [*_examples(exchange, permission), *_sized(exchange, permission)]:
            # What nobody answers shows nothing.
            if not request.is_silent:
                found.setdefault(request.frame, request)
    return list(found.values())


def commands(permission: Permission) -> list[Request]:
    """Return the examples of the messages that the user allowed, and nothing made of them."""
    names = [name for name in permission.allowed if name in permission.commands]
    exchanges = _of(permission.model, names)
    return [request for exchange in exchanges for request in _examples(exchange, permission)]


def _of(model: Model, names: list[str]) -> list[Exchange]:
    return [each for each in model.exchanges if each.request.name in names]


def _titled(request: Request) -> str:
    return f"{request.message.name}, {request.about}"


def _pairs(firsts: list[Request]) -> Iterator[tuple[Request, Request]]:
    """Pair each query with the next, and the last with the first; a single one with itself."""
    for index, one in enumerate(firsts if len(firsts) != 2 else firsts[:1]):
        yield one, firsts[(index + 1) % len(firsts)]


def _examples(exchange: Exchange, permission: Permission) -> Iterator[Request]:
    message = exchange.request
    for number, example in enumerate(message.message.examples, 1):
        values = _addressed(exchange, example.values, permission)
        yield Request(exchange, values, encode(message, values), f"example {number}")


def _sized(exchange: Exchange, permission: Permission) -> Iterator[Request]:
    """Make requests with one element, with two, and with as many as a reply can report.

    A query without a list is only made up where no example shows it.
    """
    message = exchange.request
    pattern = _addressed(exchange, _pattern(exchange), permission)
    if message.items is None:
        if not message.message.examples:
            yield Request(exchange, pattern, encode(message, pattern), "lowest values")
        return
    most = min(message.counts[-1], exchange.most or message.counts[-1], _MOST_ELEMENTS)
    elements = _elements(exchange, pattern[message.items.name])[:most]
    if not elements:
        return
    sizes = {1: "one element", 2: "two elements", len(elements): f"{len(elements)} elements"}
    for size, about in sizes.items():
        if size in message.counts and size <= len(elements):
            values = {**pattern, message.items.name: elements[:size]}
            yield Request(exchange, values, encode(message, values), about)


def _addressed(
    exchange: Exchange, values: Mapping[str, Any], permission: Permission
) -> Mapping[str, Any]:
    """Return values with the address of the device, and a running number.

    A command to those who do not answer goes to them as it is.
    """
    part, counter = exchange.address, exchange.counter
    found = dict(values) if counter is None else {counter.name: 0, **values}
    if part is None or permission.device is None:
        return found
    if exchange.request.name in permission.queries or found[part.name] not in part.silent:
        found[part.name] = permission.device
    return found


def _pattern(exchange: Exchange) -> Mapping[str, Any]:
    """Return values to vary: those of the first example, or else the lowest of each field."""
    message, part = exchange.request, exchange.address
    if message.message.examples:
        return message.message.examples[0].values
    values = values_at(message, "low", message.counts[0])
    values |= _zeros(message.arguments)
    if part is not None:
        devices = (each for each in range(part.low, part.high + 1) if each not in part.silent)
        values[part.name] = next(devices, part.low)
    return values if message.items is None else {**values, message.items.name: []}


def _zeros(slots: Iterable[Field]) -> dict[str, int]:
    """Return a zero for each number that may be zero."""
    return {slot.name: 0 for slot in slots if isinstance(slot, Number) and slot.holds(0)}


def _elements(exchange: Exchange, first: list[Any]) -> list[Any]:
    """Make elements that all differ in their first field, in the order of its values.

    Values that are a byte of the header are left out: a list could then look like a frame.
    """
    items = exchange.request.items
    number = None if items is None else items.fields[0]
    if items is None or not isinstance(number, Number) or number.is_float or items.text:
        return []
    header = set(exchange.request.frame.header)
    lowest = min((_key(items, item) for item in first), default=max(number.low, 0))
    values = [
        value
        for value in range(lowest, min(number.high, lowest + 2 * items.high) + 1)
        if header.isdisjoint(number.write(value))
    ]
    return [_element(items, value, first) for value in values]


def _key(items: Items, item: Any) -> int:
    value: int = item if items.element is None else item[items.fields[0].name]
    return value


def _element(items: Items, value: int, first: list[Any]) -> Any:
    if items.element is None:
        return value
    others = first[0] if first else {**item_at(items, "low"), **_zeros(items.fields)}
    return {**others, items.fields[0].name: value}
