"""Messages as plain data, as JSON holds it, and back: the fields by name, lists as lists."""

from __future__ import annotations

from collections.abc import Mapping

from .errors import EncodeError
from .lists import List
from .number import shown

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import Any

    from .message import Message


def to_dict(message: Message) -> dict[str, Any]:
    """Return the fields by name; each element of a list as a dict of its own fields."""
    kind = type(message)
    fields: dict[str, Any] = {}
    for name in message.__match_args__:
        field = getattr(kind, name)
        if isinstance(field, List):
            fields[name] = _listed(field, message.encode())
        else:
            value = getattr(message, name)
            fields[name] = [*value] if type(value) is tuple else value
    return fields


def _listed(items: List[Any], frame: bytes) -> list[Any]:
    """Return the list of a frame: plain values, or each element as a dict."""
    values = items.numbers(frame)
    if items.element is None:
        return [*values]
    names = items.element.__match_args__
    rows = zip(*[iter(values)] * items.width, strict=True)
    return [dict(zip(names, row, strict=True)) for row in rows]


def values_of(kind: type[Message], fields: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments that make a message of a class. Raises EncodeError for other fields."""
    if not isinstance(fields, Mapping):
        raise TypeError(f"a mapping of fields expected, such as a dict, not {shown(fields)}")
    values = {**fields}
    lists = [each for name in kind.__match_args__ if isinstance(each := getattr(kind, name), List)]
    derived = {name: each.name for each in lists for name in each.derived}
    _check(kind.__name__, "", kind.__match_args__, {**dict(kind.DEFAULTS), **values}, derived)
    for items in lists:
        if items.element is not None:
            values[items.name] = _elements(items, values[items.name])
    return values


def _elements(items: List[Any], listed: Any) -> Any:
    """Return the elements of a list as tuples where they are mappings; all else as it is."""
    if items.element is None or not isinstance(listed, (list, tuple)):
        return listed
    element, names = items.element.__name__, items.element.__match_args__
    found: list[Any] = []
    for position, each in enumerate(listed):
        if isinstance(each, Mapping):
            _check(element, f"{items.name}[{position}].", names, each, {})
        found.append(tuple(each[name] for name in names) if isinstance(each, Mapping) else each)
    return found


def _check(
    kind: str,
    place: str,
    names: tuple[str, ...],
    values: Mapping[str, Any],
    derived: Mapping[str, str],
) -> None:
    """Raise EncodeError for a field that is not there, or that nobody gives, or that is missing."""
    has = f"{kind} has {', '.join(names) or 'no fields'}"
    for name, value in values.items():
        if name in derived:
            problem = f"{shown(value)} is not given: it follows from {derived[name]}; leave it out"
            raise EncodeError(f"{place}{name}", value, problem)
        if name not in names:
            raise EncodeError(f"{place}{name}", value, f"there is no such field; {has}")
    for name in names:
        if name not in values:
            raise EncodeError(f"{place}{name}", None, f"it is missing; {has}")
