"""The facts of a protocol as plain data, such as JSON has, and back.

A key is called as the attribute is, and what is as usual is left out. New keys do not change the
form, since readers pass over those that they do not know.
"""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Mapping
from functools import cache
from pkgutil import get_data
from typing import Any, get_args, get_origin, get_type_hints

from .envelope import Envelope
from .message import Message
from .protocol import Protocol
from .slots import Body, Constant, List, Number, Packed, Slot, Text

FORM = 1
"""The form of the data. It goes up when a key means something else, or is gone."""

# The others are numbers.
_BY_ROLE: dict[str, type] = {
    "constant": Constant,
    "reserved": Constant,
    "text": Text,
    "packed": Packed,
    "list": List,
    "body": Body,
}
# The attribute of a slot that is that of the protocol, unless it says another.
_ORDER = "order"


def carried_by(package: str) -> Protocol:
    """Read the protocol that a library of this name carries."""
    return protocol_of(json.loads(get_data(package, "protocol.json") or b""))


def protocol_of(data: Mapping[str, Any]) -> Protocol:
    """Read a protocol from plain data."""
    reader = _Reader(data["byte_order"])
    frames = data.get("frames") or {"frame": data["frame"]}
    envelopes = {name: reader.envelope(slots, name) for name, slots in frames.items()}
    messages = {
        name: reader.message(name, said, envelopes) for name, said in data["messages"].items()
    }
    protocol: Protocol = reader.record(Protocol, data, envelopes=envelopes, messages=messages)
    return protocol


def data_of(protocol: Protocol) -> dict[str, Any]:
    """Return a protocol as plain data."""
    order = protocol.byte_order
    data: dict[str, Any] = {}
    for name, value in _plain(protocol, order).items():
        if name == "envelopes":
            data |= value if [*value] == ["frame"] else {"frames": value}
        else:
            data[name] = value
    data["messages"] = {name: message_data(each, order) for name, each in protocol.messages.items()}
    return data


def message_data(message: Message, order: str) -> dict[str, Any]:
    """Return a message as plain data; its numbers have this byte order unless they say another."""
    ids = {"id": message.ids[0]} if len(message.ids) == 1 else {"ids": [*message.ids]}
    data: dict[str, Any] = _plain(message, order)
    return (ids if message.ids else {}) | data


@cache
def _attributes(kind: Any) -> list[tuple[str, str, Any, dataclasses.Field[Any]]]:
    """Return name, key and type of each attribute, and how it is declared."""
    types = get_type_hints(kind)
    return [
        (each.name, each.metadata.get("key", each.name), types[each.name], each)
        for each in dataclasses.fields(kind)
        if not each.metadata.get("apart")
    ]


def _plain(value: Any, order: str) -> Any:
    if isinstance(value, Envelope):
        unsent = [_plain(slot, order) for slot in value.unsent]
        return [*(_plain(slot, order) for slot in value.slots), *unsent]
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {
            key: _plain(each, order)
            for name, key, _, declared in _attributes(type(value))
            for each in (getattr(value, name),)
            if not _is_usual(each, declared) and not (name == _ORDER and each == order)
        }
    if isinstance(value, Mapping):
        return {str(name): _plain(each, order) for name, each in value.items()}
    if isinstance(value, bytes):
        return value.hex(" ").upper()
    if isinstance(value, tuple):
        # Of what has a place instead of a name, nothing is left out but at the end.
        usual = getattr(value, "_field_defaults", {})
        kept = len(value) - (bool(usual) and value[-1] == [*usual.values()][-1])
        return [_plain(each, order) for each in value[:kept]]
    return value


def _is_usual(value: Any, declared: dataclasses.Field[Any]) -> bool:
    if declared.metadata.get("always"):
        return False
    is_empty = declared.default_factory is not dataclasses.MISSING and not value
    return is_empty or bool(value == declared.default)


@dataclasses.dataclass(frozen=True)
class _Reader:
    """What reads facts, in a protocol whose numbers have a byte order unless they say another."""

    order: str

    def envelope(self, data: Any, name: str = "frame") -> Envelope:
        """Read an envelope: its slots, those that are not sent among them."""
        slots = [self.slot(each) for each in data]
        unsent = [each for each in slots if isinstance(each, Number) and not each.sent]
        sent = tuple(each for each in slots if each not in unsent)
        return Envelope(name, sent, tuple(unsent))

    def slot(self, data: Any) -> Slot:
        """Read a slot, whose role tells what it is."""
        slot: Slot = self.record(_BY_ROLE.get(data["role"], Number), data)
        return slot

    def message(self, name: str, data: Any, envelopes: Mapping[str, Envelope]) -> Message:
        """Read a message in one of the envelopes."""
        envelope = envelopes[data.get("frame", next(iter(envelopes)))]
        ids = (data["id"],) if "id" in data else tuple(data.get("ids", ()))
        message: Message = self.record(Message, data, name=name, envelope=envelope, ids=ids)
        return message

    def record(self, kind: Any, data: Any, **given: Any) -> Any:
        """Read what has a key for each attribute, but for what is given."""
        for name, key, type_, _ in _attributes(kind):
            if key in data and name not in given:
                given[name] = self._value(type_, data[key])
            elif name == _ORDER:
                given[name] = self.order
        return kind(**given)

    def _value(self, kind: Any, data: Any) -> Any:
        """Read a value of a type."""
        arguments, origin = get_args(kind), get_origin(kind)
        if origin is tuple:
            data = tuple(self._value(arguments[0], each) for each in data)
        elif origin is Mapping:
            key, each_kind = arguments
            data = {key(name): self._value(each_kind, each) for name, each in data.items()}
        elif Number in arguments:
            data = self.slot(data)
        elif arguments and type(None) in arguments:
            # Of what there may be nothing, there is something; it is a record, or as it stands.
            records = [each for each in arguments if each not in (type(None), int, str)]
            data = self._value(records[0], data) if records else data
        elif kind is Envelope:
            data = self.envelope(data)
        elif kind is bytes:
            data = bytes.fromhex(data)
        elif dataclasses.is_dataclass(kind):
            data = self.record(kind, data)
        elif isinstance(data, list):
            data = kind(*data)
        return data
