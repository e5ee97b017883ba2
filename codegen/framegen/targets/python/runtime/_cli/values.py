"""The fields of a message as text: printed with units and names, and read from that notation."""

from __future__ import annotations

from warnings import catch_warnings, simplefilter

from .._frame.errors import EncodeError
from .numerals import whole_in_any_base
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from .._frame.items import Items
    from .._frame.message import Message
    from .._frame.number import Number


def fields_in_json(message: Message) -> str:
    """Return what `to_dict` gives as the text of a JSON object, many times as fast."""
    items = message.SHAPE.items
    shown: list[str] = []
    for name in message.__match_args__:
        if items is not None and items.name == name:
            listed = _listed(items, message, _json_of(items), ", ")
            shown.append(f'"{name}": [{listed}]')
        else:
            shown.append(f'"{name}": {getattr(message, name)}')
    return f"{{{', '.join(shown)}}}"


def fields_as_text(message: Message) -> str:
    """Return the fields as `delay=10 ms items=1:20,2:30`."""
    items = message.SHAPE.items
    shown: list[str] = []
    for name in message.__match_args__:
        if items is not None and items.name == name:
            shown.append(f"{name}={_listed(items, message, ':'.join(['%d'] * items.width), ',')}")
        else:
            number = getattr(type(message), name)
            shown.append(f"{name}={_number_as_text(number, getattr(message, name))}")
    return " ".join(shown)


def _listed(items: Items[Any], message: Message, element: str, comma: str) -> str:
    """Return the elements of a list as text; `element` has a %d for each of its numbers."""
    numbers = items.numbers(message.encode())
    text: str = comma.join([element] * (len(numbers) // items.width)) % numbers
    return text


def _json_of(items: Items[Any]) -> str:
    """Return the format of an element in JSON."""
    if items.element is None:
        return "%d"
    fields = ", ".join([f'"{field.name}": %d' for field in items.fields])
    return f"{{{fields}}}"


def _number_as_text(number: Number, value: int) -> str:
    unit = f" {number.unit}" if number.unit else ""
    if not number.names:
        return f"{value}{unit}"
    named = [f" ({name})" for name, known in number.names.items() if known == value]
    return f"{value}{unit}{''.join(named)}"


def message_from_text(kind: type[Message], words: list[str]) -> Message:
    """Return the message with the fields given as `delay=10 items=1:20,2:30`."""
    given = fields_from_text(kind, words)
    try:
        with catch_warnings():
            # A program is warned at its own line; a command says so in its own words.
            simplefilter("ignore", DeprecationWarning)
            return kind(**given)
    except EncodeError as error:
        raise UsageError(str(error)) from None


def fields_from_text(kind: type[Message], words: list[str]) -> dict[str, Any]:
    """Return all fields of a message by name, not checked against their ranges."""
    given: dict[str, Any] = {}
    for word in words:
        name, equals, text = word.partition("=")
        if not equals:
            raise UsageError(f"{word!r} is no field: write it as NAME=VALUE; {_usage(kind)}")
        if name not in kind.__match_args__:
            raise UsageError(f"{kind.__name__} has no field {name!r}; {_usage(kind)}")
        if name in given:
            raise UsageError(f"{name} is given twice")
        given[name] = _read_field(kind, name, text)
    missing = [name for name in kind.__match_args__ if name not in given]
    if missing:
        raise UsageError(f"{kind.__name__} needs {' and '.join(missing)}; {_usage(kind)}")
    return given


def _usage(kind: type[Message]) -> str:
    items = kind.SHAPE.items
    fields: list[str] = []
    for name in kind.__match_args__:
        if items is None or items.name != name:
            fields.append(f"{name}={name.upper()}")
        else:
            element = ":".join(field.name.upper() for field in items.fields)
            fields.append(f"{name}={element},...")
    return f"it is written {' '.join([kind.__name__, *fields])}"


def _read_field(kind: type[Message], name: str, text: str) -> Any:
    items = kind.SHAPE.items
    if items is None or items.name != name:
        return _read_number(getattr(kind, name), text, name)
    words = text.split(",") if text else []
    return [_read_element(items, word, f"{name}[{at}]") for at, word in enumerate(words)]


def _read_element(items: Items[Any], word: str, path: str) -> Any:
    if items.element is None:
        return _read_number(items.fields[0], word, path)
    parts = word.split(":")
    if len(parts) != len(items.fields):
        wanted = ":".join(field.name for field in items.fields)
        raise UsageError(f"{path}: {word!r} is not {wanted}")
    return tuple(
        _read_number(field, part, f"{path}.{field.name}")
        for field, part in zip(items.fields, parts, strict=True)
    )


def _read_number(number: Number, text: str, path: str) -> int:
    named = number.names.get(text)
    if named is not None:
        return named
    try:
        return whole_in_any_base(text)
    except ValueError:
        names = "".join(f", or {name}" for name in number.names)
        raise UsageError(
            f"{path}: {text[:40]!r} is no number: write it like 12 or 0x0C{names}"
        ) from None
