"""The fields of a message as text: printed with units and names, and read from that notation.

A list is `items=1,2,3`, or `items=1:20,2:30` where its elements have several fields. In text, `%2C`
is a comma, and likewise whatever else would end it.
"""

from __future__ import annotations

import json
import math
import re
from operator import attrgetter
from warnings import catch_warnings, simplefilter

from ..frame.errors import EncodeError
from ..frame.lists import List
from ..frame.number import set_bits
from .numerals import whole_in_any_base
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeAlias

    from ..frame.message import Message

    # What returns a field of a message as text; None for one that is absent.
    Show: TypeAlias = Callable[[Message], "str | None"]

# How the fields of each class of messages are shown, made when it is first seen.
_IN_JSON: dict[type[Message], Callable[[Message], str]] = {}
_IN_TEXT: dict[type[Message], Callable[[Message], str]] = {}
# What would end a text, or not be seen; and how that is written.
_SPECIAL = re.compile(r"[^!-~]|[%,:]")
# A text without any characters, in a list: zeros at its end are no part of it.
EMPTY = "%00"
_ESCAPED = re.compile(r"%([0-9A-Fa-f]{2})")


def fields_in_json(message: Message) -> str:
    """Return what `to_dict` gives as the text of a JSON object, many times as fast."""
    kind = type(message)
    show = _IN_JSON.get(kind)
    if show is None:
        show = _IN_JSON[kind] = _all_in_json(kind)
    return show(message)


def fields_as_text(message: Message) -> str:
    """Return the fields as `delay=10 ms items=1:20,2:30`; those that are absent are left out."""
    kind = type(message)
    show = _IN_TEXT.get(kind)
    if show is None:
        show = _IN_TEXT[kind] = _all_as_text(kind)
    return show(message)


def _all_in_json(kind: type[Message]) -> Callable[[Message], str]:
    """Return what shows the fields of a class of messages in JSON."""
    fields = [getattr(kind, name) for name in kind.__match_args__]
    if fields and all(map(_is_whole, fields)):
        return _formatted(
            f"{{{', '.join(f'{json.dumps(each.name)}: %d' for each in fields)}}}", fields
        )
    shows = [(f"{json.dumps(field.name)}: ", _json_of(field)) for field in fields]

    def shown(message: Message) -> str:
        return f"{{{', '.join([f'{name}{show(message)}' for name, show in shows])}}}"

    return shown


def _all_as_text(kind: type[Message]) -> Callable[[Message], str]:
    """Return what shows the fields of a class of messages as text."""
    fields = [getattr(kind, name) for name in kind.__match_args__]
    if fields and all(_is_whole(field) and not _is_named(field) for field in fields):
        return _formatted(" ".join(f"{each.name}=%d{_unit(each)}" for each in fields), fields)
    shows = [(field.name, _text_of(field)) for field in fields]

    def shown(message: Message) -> str:
        found = [(name, show(message)) for name, show in shows]
        return " ".join([f"{name}={text}" for name, text in found if text is not None])

    return shown


def _formatted(form: str, fields: list[Any]) -> Callable[[Message], str]:
    """Return what puts the numbers of a message into a text, all at once."""
    values: Any = attrgetter(*(field.name for field in fields))
    return lambda message: form % values(message)


def _unit(field: Any) -> str:
    """Return the unit of a number, as a format."""
    return f" {field.unit.replace('%', '%%')}" if field.unit else ""


def _is_named(field: Any) -> bool:
    """Tell whether values or bits of a field have names."""
    return bool(field.names or getattr(field, "bits", None))


def _json_of(field: Any) -> Show:
    """Return what shows a field in JSON."""
    read: Any = attrgetter(field.name)
    if isinstance(field, List):
        return _listed_in_json(field)
    if _is_whole(field):
        return lambda message: str(read(message))
    return lambda message: _in_json(read(message))


def _in_json(value: Any) -> str:
    if isinstance(value, float) and not math.isfinite(value):
        value = str(value)
    return json.dumps(value)


def _listed_in_json(items: List[Any]) -> Show:
    """Return what shows a list in JSON, all of its numbers at once where they are whole ones."""
    names = [f'"{field.name}": ' for field in items.fields] if items.element else [""]
    begin, end = ("{", "}") if items.element else ("", "")
    if all(map(_is_whole, items.fields)):
        element = f"{begin}{', '.join(f'{name}%d' for name in names)}{end}"
        return lambda message: f"[{_listed(items, message, element, ', ')}]"

    def shown(message: Message) -> str:
        values = iter(map(_in_json, items.numbers(message.encode())))
        rows = zip(*[values] * items.width, strict=True)
        elements = [
            ", ".join(f"{name}{value}" for name, value in zip(names, row, strict=True))
            for row in rows
        ]
        return f"[{', '.join(f'{begin}{each}{end}' for each in elements)}]"

    return shown


def _text_of(field: Any) -> Show:
    """Return what shows a field as text."""
    read: Any = attrgetter(field.name)
    if not isinstance(field, List):
        if _is_whole(field) and not _is_named(field):
            return _formatted(f"%d{_unit(field)}", [field])
        return lambda message: _as_text(field, read(message))
    if all(map(_is_whole, field.fields)):
        element = ":".join(["%d"] * field.width)
        return lambda message: _listed(field, message, element, ",")

    def shown(message: Message) -> str:
        values = iter([as_word(value) or EMPTY for value in field.numbers(message.encode())])
        return ",".join(":".join(row) for row in zip(*[values] * field.width, strict=True))

    return shown


def _is_whole(field: Any) -> bool:
    """Tell whether a field is always a whole number."""
    return isinstance(getattr(field, "highest", None), int)


def _listed(items: List[Any], message: Message, element: str, comma: str) -> str:
    """Return the elements of a list as text; `element` has a %d for each of its numbers."""
    numbers = items.numbers(message.encode())
    text: str = comma.join([element] * (len(numbers) // items.width)) % numbers
    return text


def _as_text(field: Any, value: Any) -> str | None:
    """Return a value with its unit, or with the name that it has; None where it is absent."""
    field = getattr(field, "number", field)
    if value is None:
        return None
    if isinstance(value, tuple):
        return ",".join(map(str, value))
    if isinstance(value, str):
        return as_word(value)
    unit = f" {field.unit}" if field.unit else ""
    named = [name for name, known in field.names.items() if known == value]
    bits = getattr(field, "bits", None) or {}
    named += set_bits(int(value), bits) if bits else []
    return f"{value}{unit} ({', '.join(named)})" if named else f"{value}{unit}"


def as_word(value: Any) -> str:
    """Return a value as one word; of a text, what would end it is escaped."""
    if not isinstance(value, str):
        return str(value)
    return _SPECIAL.sub(lambda found: f"%{ord(found[0]):02X}", value)


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
    optional = dict(kind.DEFAULTS)
    missing = [name for name in kind.__match_args__ if name not in given and name not in optional]
    if missing:
        raise UsageError(f"{kind.__name__} needs {' and '.join(missing)}; {_usage(kind)}")
    return given


def _usage(kind: type[Message]) -> str:
    optional = dict(kind.DEFAULTS)
    fields: list[str] = []
    for name in kind.__match_args__:
        word = f"{name}={written(getattr(kind, name))}"
        fields.append(f"[{word}]" if name in optional else word)
    return f"it is written {' '.join([kind.__name__, *fields])}"


def written(field: Any) -> str:
    """Return how a field is written: its name, or those of the fields of an element."""
    if not isinstance(field, List):
        length = getattr(field, "length", None)
        name: str = field.name.upper()
        return name if length is None else f"{name},..."
    return f"{':'.join(each.name.upper() for each in field.fields)},..."


def _read_field(kind: type[Message], name: str, text: str) -> Any:
    field = getattr(kind, name)
    words = text.split(",") if text else []
    if isinstance(field, List):
        return [_read_element(field, word, f"{name}[{at}]") for at, word in enumerate(words)]
    if hasattr(field, "length"):
        return [_read_whole(field, word, f"{name}[{at}]") for at, word in enumerate(words)]
    return _read_value(field, text, name)


def _read_element(items: List[Any], word: str, path: str) -> Any:
    if items.element is None:
        return _read_value(items.fields[0], word, path)
    parts = word.split(":")
    if len(parts) != len(items.fields):
        wanted = ":".join(field.name for field in items.fields)
        raise UsageError(f"{path}: {word!r} is not {wanted}")
    return tuple(
        _read_value(field, part, f"{path}.{field.name}")
        for field, part in zip(items.fields, parts, strict=True)
    )


def _read_value(field: Any, text: str, path: str) -> Any:
    field = getattr(field, "number", field)
    if _is_whole(field):
        return _read_whole(field, text, path)
    if field.plain:
        return _read_floating(text, path)
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)


def _read_whole(number: Any, text: str, path: str) -> int:
    named: int | None = number.names.get(text)
    if named is None:
        named = _bits(number, text)
    if named is not None:
        return named
    try:
        return whole_in_any_base(text)
    except ValueError:
        bits = _masks(number)
        names = "".join(f", or {name}" for name in [*number.names, *bits])
        raise UsageError(
            f"{path}: {text[:40]!r} is no number: write it like 12 or 0x0C{names}"
        ) from None


def _masks(number: Any) -> dict[str, int]:
    """Return the bits of a number that have a name; packed numbers have none, but a width."""
    bits = getattr(number, "bits", None)
    return bits if isinstance(bits, dict) else {}


def _bits(number: Any, text: str) -> int | None:
    """Return the number in which bits of these names are set; None if there is no such name."""
    bits = _masks(number)
    found = 0
    for name in text.split("+"):
        if name not in bits:
            return None
        found |= bits[name]
    return found


def _read_floating(text: str, path: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise UsageError(f"{path}: {text[:40]!r} is no number: write it like 1.5") from None
