"""The origins of a library's names: what of a spec each is called after."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.spec import ListField, NumberField
from framegen.language.values import Direction
from framegen.model.client_names import client_names
from framegen.model.exchanges import method_of, snake_case
from framegen.targets.python.names import (
    bit_name,
    constant_name,
    id_name,
    mask_name,
    names_of,
    signed_name,
    strategy_name,
    union_name,
)
from framegen.targets.python.spelling import direction_member

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.spec import AnyField, Message
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath
    from framegen.targets.python.names import Names

# The classes with a method for each message of the client, but for the client itself: these leave
# out the address of a device.
DEVICES = ("OneDevice", "AllDevices")
POSE_METHODS = ("hold", "present", "targets")
CLIENT = ("protocol", "client")


@dataclass(frozen=True, slots=True)
class Origin:
    """What a name is called after: a path in a spec, and which of the names that follow from it.

    `owner` is what else it depends on, such as the message in whose class a part of all frames is.
    """

    role: str
    path: KeyPath
    owner: KeyPath = ()


def origins(model: Model) -> dict[str, Origin]:
    """Return the origin of each name in the library of a model, `ServoMove.time_ms` and all."""
    found: dict[str, Origin] = {}
    for name, origin in _origins(model):
        # The elements of two lists may be of one class: it is that of the first.
        found.setdefault(name, origin)
    return found


def _origins(model: Model) -> Iterator[tuple[str, Origin]]:
    names = names_of(model)
    spec = model.spec
    yield from ((name, Origin(role, CLIENT)) for role, name in clients_of(model).items())
    for name, layout in model.messages.items():
        yield from _of_message(names, name, layout)
        message = spec.messages[name]
        if message.direction == model.roles.sent:
            yield from _of_method(names, name, message)
    for end in spec.endpoints:
        yield union_name(names.of("endpoint", end)), Origin("union", ("endpoints", end))
    for way in model.directions:
        ends = (("endpoints", way.sender), ("endpoints", way.receiver))
        named = (names.of("endpoint", end) for end in (way.sender, way.receiver))
        member = direction_member(Direction(*named))
        yield f"Direction.{member}", Origin("direction", *ends)
    if spec.pose is not None:
        for key in POSE_METHODS:
            method = names.of("method", getattr(spec.pose, key))
            for client in ("threads", "asyncio"):
                owner = clients_of(model)[client]
                yield f"{owner}.{method}", Origin(f"{client} method", ("pose", key))


def _of_message(names: Names, name: str, layout: MessageLayout) -> Iterator[tuple[str, Origin]]:
    path: KeyPath = ("messages", name)
    made = names.of("message", name)
    yield made, Origin("class", path)
    yield f"{made}.absent", Origin("absent", path)
    yield f"{made}.columns", Origin("columns", path)
    yield f"{made}.COMMAND", Origin("command", path)
    yield f"{made}.DIRECTION", Origin("way", path)
    yield f"strategies.{strategy_name(made)}", Origin("strategy", path)
    yield f"Device.on_{snake_case(made)}", Origin("handler", path)
    ids = layout.message.id
    parts_of_id: list[str] = [*ids] if isinstance(ids, dict) else []
    for part in parts_of_id:
        yield f"{made}.{id_name(part)}", Origin("id", (*path, "id", part))
    parts = frame_path(names.model, layout.frame.name)
    for slot in layout.frame.given:
        yield from _of_field(names, "field", made, (*parts, slot.name), slot.field, path)
    for field_name, field in layout.message.fields.items():
        yield from _of_field(names, "field", made, (*path, "fields", field_name), field, path)


def _of_field(
    names: Names, kind: str, owner: str, path: KeyPath, field: AnyField, message: KeyPath
) -> Iterator[tuple[str, Origin]]:
    name = names.of(kind, str(path[-1]))
    yield f"{owner}.{name}", Origin("field", path, message)
    if isinstance(field, ListField):
        element = names.of("element", field.element)
        yield element, Origin("element", path)
        yield f"{element}.absent", Origin("absent", path)
        for inner, number in field.fields.items():
            inside = (*path, "fields", inner)
            yield from _of_field(names, "field of an element", element, inside, number, path)
    if not isinstance(field, NumberField):
        return
    yield f"{owner}.{signed_name(name)}", Origin("signed", path, message)
    for value in field.values:
        at = (*path, "values", value)
        yield f"{owner}.{constant_name(name, value)}", Origin("value", at, message)
    for bit in field.bits:
        at = (*path, "bits", bit)
        yield f"{owner}.{mask_name(field, name, bit)}", Origin("mask", at, message)
        yield f"{owner}.{bit_name(name, bit)}", Origin("bit", at, message)


def _of_method(names: Names, name: str, message: Message) -> Iterator[tuple[str, Origin]]:
    method = names.of("method", method_of(name, message).name)
    owners = {each: clients_of(names.model)[each] for each in ("threads", "asyncio")}
    owners |= {each: each for device in DEVICES for each in (device, f"Async{device}")}
    for role, owner in owners.items():
        yield f"{owner}.{method}", Origin(f"{role} method", ("messages", name))


def clients_of(model: Model) -> Mapping[str, str]:
    """Return the names that follow from that of the client, each by what it is."""
    names = client_names(model.spec)
    return {
        "threads": names.threads,
        "asyncio": names.asyncio,
        "opener": names.opener,
        "async opener": names.async_opener,
    }


def frame_path(model: Model, frame: str) -> KeyPath:
    """Return the path of a kind of frame."""
    return ("frames", frame) if model.spec.frames else ("frame",)


def requests(model: Model) -> Mapping[str, str]:
    """Return the class of the message that each method of a client sends, by the method's name."""
    names = names_of(model)
    return {
        names.of("method", method_of(name, message).name): names.of("message", name)
        for name, message in model.spec.messages.items()
        if message.direction == model.roles.sent
    }
