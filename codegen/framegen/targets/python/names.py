"""The names of a spec in the library: the one place where a name that is taken is changed.

The library is made of a model in which every name is the library's own already, so that whatever
shows one shows it as it is in code. Frames, test vectors and the reference keep the author's names.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, TypeVar

from framegen.language.spec import IdPart, ListField
from framegen.language.values import Direction, Failure, Method
from framegen.model.client_names import client_names
from framegen.model.exchanges import arguments_of, method_of, snake_case
from framegen.model.roles import Roles
from framegen.model.slots import Constant, Items, Number, Packed, Text
from framegen.targets.python.reserved import CLIENTS, RESERVED
from framegen.targets.target import BentName

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from framegen.language.spec import AnyField, Frame, Message, NumberField, Pose, Spec
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Body, MessageSlot
    from framegen.reading.yamltree import KeyPath
    from framegen.targets.target import Reserved

_Named = TypeVar("_Named", bound="Number | Text | Packed")
_TAKEN = {
    (row.kind, word): row
    for row in reversed(RESERVED)
    for word in row.words
    if row.words is not CLIENTS
}
_CLASSES = ("message", "element")
# What the constants of envelopes end in, and no other: a message class names one in its body.
_ENVELOPE = "_ENVELOPE"


@lru_cache(maxsize=4)
def names_of(model: Model) -> Names:
    """Return the names of a model's library; the same object for the same model."""
    return Names(model)


def bent(model: Model) -> list[BentName]:
    """Return the names that differ in the library, in the order of the spec."""
    return names_of(model).bent


def strategy_name(message: str) -> str:
    """Return the name of a message's strategy: `servo_move` for ServoMove."""
    name = snake_case(message)
    return _behind(_TAKEN.get(("strategy", name)), name)


def constant_name(field: str, value: str) -> str:
    """Return the constant of a named value: `TIMES_UNLIMITED`."""
    name = f"{_plain(field)}_{value}".upper()
    return _behind(_TAKEN.get(("constant", name)), name)


def bit_name(field: str, bit: str) -> str:
    """Return the property that reads named bits of a field: `error_voltage`."""
    name = f"{_plain(field)}_{bit}"
    return _behind(_TAKEN.get(("bits", name)), name)


def mask_name(field: NumberField, name: str, bit: str) -> str:
    """Return the constant that has just these bits set: `ERROR_VOLTAGE`, unless a value has it."""
    found = constant_name(name, bit)
    return f"{found}_MASK" if bit in field.values else found


def id_name(part: str) -> str:
    """Return the constant of one of several ids: `CLASS`."""
    name = part.upper()
    return f"{name}_" if name.endswith(_ENVELOPE) else _behind(_TAKEN.get(("id", name)), name)


def id_names(frame: Envelope) -> list[str]:
    """Return the constants of the ids of messages in a frame: one by itself is the command."""
    return ["COMMAND"] if len(frame.sent_ids) == 1 else [id_name(part.name) for part in frame.ids]


def envelope_name(frame: str) -> str:
    """Return the constant of an envelope: `ASK_ENVELOPE`."""
    return f"{frame}{_ENVELOPE}".upper()


def signed_name(field: str) -> str:
    """Return the property that reads a field as signed."""
    return f"signed_{_plain(field)}"


def union_name(endpoint: str) -> str:
    """Return the name of all messages that an end sends: `HostMessage`."""
    return f"{endpoint.title().replace('_', '')}Message"


def _plain(name: str) -> str:
    """Return a name that may have been changed, as it is in the middle of another."""
    return name.rstrip("_")


def _behind(row: Reserved | None, name: str) -> str:
    return name if row is None else name + row.suffix


@dataclass(frozen=True, eq=False)
class Names:
    """The names of one spec in its library."""

    model: Model

    def of(self, kind: str, name: str) -> str:
        """Return a name of a kind as it is in the library; the kinds are those of RESERVED."""
        why, suffix = self._taken(kind, name)
        if not why:
            return name
        found = name + suffix
        while self._taken(kind, found)[0] or (kind in _CLASSES and found.lower() in self._classes):
            found += suffix
        return found

    def _taken(self, kind: str, name: str) -> tuple[str, str]:
        """Return why a name is taken, and the suffix that it gets; empty if it is free."""
        row = _TAKEN.get((kind, name))
        if row is not None:
            return row.why, row.suffix
        if kind == "id" and name.endswith(_ENVELOPE):
            return "may be the constant of an envelope", "_"
        if kind in _CLASSES and name in client_names(self.model.spec).classes:
            return "is a client of this library", kind.capitalize()
        if kind in _CLASSES and name in self._unions:
            return "is whatever one end sends", kind.capitalize()
        if kind == "element" and name in self._ids:
            return "is an id of messages, which hides it there", "Element"
        why = self._beside(name) if kind.startswith("field") else ""
        return why, "_" if why else ""

    def _beside(self, field: str) -> str:
        """Return what stands beside the fields under this name; empty where nothing does."""
        if field in self._signed:
            return f"is where `{field.removeprefix('signed_')}` is read as signed"
        if field in self._bits:
            return "is where bits of another field are read"
        return "is a variable of the client's methods" if field in self._posed else ""

    @cached_property
    def _classes(self) -> frozenset[str]:
        """The classes in lower case: those that differ only in capitals clash as functions."""
        slots = (slot for message in self.model.messages.values() for slot in message.fields)
        elements = [slot.element for slot in slots if isinstance(slot, Items) and slot.element]
        return frozenset(name.lower() for name in (*self.model.messages, *elements))

    @cached_property
    def _unions(self) -> frozenset[str]:
        """The types of all that an end sends."""
        return frozenset(union_name(self.of("endpoint", end)) for end in self.model.spec.endpoints)

    @cached_property
    def _ids(self) -> frozenset[str]:
        """The constants of ids, which the classes of messages have in front of their fields."""
        return frozenset(
            name for frame in self.model.envelopes.values() for name in id_names(frame)
        )

    @cached_property
    def _signed(self) -> frozenset[str]:
        """The properties that read a field as signed, of any message."""
        return frozenset(
            signed_name(number.name)
            for message in self.model.messages.values()
            for number in message.numbers_by_path.values()
            if number.field.signed_as is not None
        )

    @cached_property
    def _bits(self) -> frozenset[str]:
        """The properties that read named bits of a field, of any message."""
        return frozenset(
            bit_name(number.name, bit)
            for message in self.model.messages.values()
            for number in message.numbers_by_path.values()
            for bit in number.field.bits
        )

    @cached_property
    def _posed(self) -> frozenset[str]:
        """The names in the pose methods that a field must not have where it is an argument of them.

        Elsewhere such a field is as good as any other.
        """
        pose = self.model.spec.pose
        if pose is None:
            return frozenset()
        held = arguments_of(self.model.spec.messages[pose.read])
        moved = self.model.spec.messages[pose.move]
        held += [name for name in arguments_of(moved) if moved.fields[name].counted_by is None]
        return frozenset(["targets"]).intersection(held)

    @cached_property
    def bent(self) -> list[BentName]:
        """Each name that differs here, by its places in the spec."""
        found = []
        for path, kind, name in self._given():
            written = self.of(kind, name)
            if written != name:
                found.append(BentName(path, kind, name, written, self._taken(kind, name)[0]))
        return found

    def _given(self) -> Iterator[tuple[KeyPath, str, str]]:
        """Yield each name that something in the library is called after: place, kind, name."""
        spec = self.model.spec
        for name in spec.endpoints:
            yield ("endpoints", name), "endpoint", name
        yield from _frame_names(spec)
        for name, message in spec.messages.items():
            here: KeyPath = ("messages", name)
            yield here, "message", name
            yield here, "strategy", snake_case(self.of("message", name))
            if message.direction == self.model.roles.sent:
                declared = here if message.method is None else (*here, "method")
                yield declared, "method", method_of(name, message).name
            for field_name, field in message.fields.items():
                yield from _field_names((*here, "fields", field_name), field_name, field)
        if spec.pose is not None:
            for key in _POSE_METHODS:
                yield ("pose", key), "method", getattr(spec.pose, key)

    @cached_property
    def library(self) -> Model:
        """The model in these names; the same model where no name differs."""
        if not self.bent:
            return self.model
        spec = self._spec()
        roles = self.model.roles
        ends = Roles(*(self.of("endpoint", end) for end in (roles.client, roles.device)))
        frames = {name: self._envelope(each) for name, each in self.model.envelopes.items()}
        layouts = [
            self._layout(layout, spec.messages[self.of("message", name)], frames)
            for name, layout in self.model.messages.items()
        ]
        messages = {each.name: each for each in layouts}
        return replace(self.model, spec=spec, roles=ends, envelopes=frames, messages=messages)

    def message(self, name: str) -> MessageLayout:
        """Return a message of the spec, in the names of the library."""
        return self.library.messages[self.of("message", name)]

    def values(self, message: str, values: dict[str, Any]) -> dict[str, Any]:
        """Return the values of an example, by the names of the fields in the library."""
        fields = self.model.spec.messages[message].fields
        return {
            self.of("field", name): [
                {self.of("field of an element", inner): number for inner, number in item.items()}
                for item in value
            ]
            if isinstance(fields.get(name), ListField)
            else value
            for name, value in values.items()
        }

    def _spec(self) -> Spec:
        spec = self.model.spec
        return spec.model_copy(
            update={
                "endpoints": {self.of("endpoint", n): about for n, about in spec.endpoints.items()},
                "messages": {
                    self.of("message", name): self._message(name, message)
                    for name, message in spec.messages.items()
                },
                "pose": None if spec.pose is None else self._pose(spec.pose),
            }
        )

    def _pose(self, pose: Pose) -> Pose:
        messages = {key: self.of("message", getattr(pose, key)) for key in _POSED}
        methods = {key: self.of("method", getattr(pose, key)) for key in _POSE_METHODS}
        return pose.model_copy(update=messages | methods)

    def _message(self, name: str, message: Message) -> Message:
        examples = [
            example.model_copy(update={"values": self.values(name, example.values)})
            for example in message.examples
        ]
        sent = message.direction == self.model.roles.sent
        return message.model_copy(
            update={
                "direction": self._direction(message.direction),
                "reply": message.reply and self.of("message", message.reply),
                "refusal": message.refusal and self.of("message", message.refusal),
                "failure": message.failure and self._failure(message.failure),
                "reports": [self.of("message", each) for each in message.reports],
                "acknowledged": message.acknowledged and self.of("message", message.acknowledged),
                "lasts": message.lasts and self.of("field", message.lasts),
                "asks_for": message.asks_for and self.of("field", message.asks_for),
                "echoed": {
                    self._path(own): self._path(echo) for own, echo in message.echoed.items()
                },
                "method": self._method(name, message) if sent else None,
                "fields": {self.of("field", n): self._field(f) for n, f in message.fields.items()},
                "examples": examples,
            }
        )

    def _direction(self, direction: Direction) -> Direction:
        ends = direction.sender, direction.receiver
        return Direction(*(self.of("endpoint", end) for end in ends))

    def _method(self, name: str, message: Message) -> Method:
        method = method_of(name, message)
        return Method(
            self.of("method", method.name),
            tuple(self.of("field", each) for each in method.arguments),
            method.result and self.of("field", method.result),
        )

    def _failure(self, failure: Failure) -> Failure:
        return Failure(self.of("field", failure.field), failure.good)

    def _path(self, path: str) -> str:
        name, dot, inner = path.partition(".")
        return f"{self.of('field', name)}{dot}{self.of('field of an element', inner)}"

    def _field(self, field: AnyField) -> AnyField:
        counters = {
            key: self.of("field", name)
            for key in ("counted_by", "sized_by")
            if (name := getattr(field, key)) is not None
        }
        if not isinstance(field, ListField):
            return field.model_copy(update=counters)
        inner = {self.of("field of an element", name): each for name, each in field.fields.items()}
        element = self.of("element", field.element)
        return field.model_copy(update={**counters, "element": element, "fields": inner})

    def _envelope(self, envelope: Envelope) -> Envelope:
        """Return an envelope whose address and running number have these names."""
        given = {slot.name: self.of("field", slot.name) for slot in envelope.given}
        slots: list[Constant | Number | Body] = []
        for slot in envelope.slots:
            name = given.get(slot.name, slot.name)
            if isinstance(slot, Number):
                of = tuple(given.get(each, each) for each in slot.of)
                slots.append(replace(slot, name=name, of=of))
            else:
                slots.append(slot)
        return replace(envelope, slots=tuple(slots))

    def _layout(
        self, layout: MessageLayout, message: Message, frames: dict[str, Envelope]
    ) -> MessageLayout:
        """Return the layout of a message in these names; no slot moves."""
        frame = frames[layout.frame.name]
        fields = {slot.name: slot for slot in layout.body}
        numbers: dict[str, Number] = {}
        slots: list[MessageSlot] = []
        for slot in (*frame.head, *layout.body, *frame.tail):
            if isinstance(slot, Items):
                slots.append(self._items(slot, numbers, message))
            elif slot is not fields.get(slot.name) or isinstance(slot, Constant):
                slots.append(slot)
            elif isinstance(slot, Number):
                numbers[slot.name] = self._number("field", slot, message.fields)
                slots.append(numbers[slot.name])
            else:
                slots.append(self._number("field", slot, message.fields))
        name = self.of("message", layout.name)
        return replace(layout, name=name, message=message, frame=frame, slots=tuple(slots))

    def _items(self, items: Items, numbers: dict[str, Number], message: Message) -> Items:
        name = self.of("field", items.name)
        field = message.fields[name]
        inside = isinstance(field, ListField)
        kind = "field of an element" if inside else "field"
        fields: Any = field.fields if isinstance(field, ListField) else message.fields
        return replace(
            items,
            name=name,
            element=items.element and self.of("element", items.element),
            slots=tuple(
                each if isinstance(each, Constant) else self._number(kind, each, fields)
                for each in items.slots
            ),
            counters=tuple(numbers[each.name] for each in items.counters),
            field=field,
        )

    def _number(self, kind: str, number: _Named, fields: Any) -> _Named:
        name = self.of(kind, number.name)
        return replace(number, name=name, field=fields[name])


# The parts of a frame that a user gives.
_GIVEN = ("address", "counter")
_POSED = ("read", "move", "release")
_POSE_METHODS = ("hold", "present", "targets")


def _frames(spec: Spec) -> Iterator[tuple[KeyPath, Frame]]:
    """Yield the parts of each kind of frame with their place."""
    if not spec.frames:
        yield ("frame",), spec.frame or {}
    for name, parts in spec.frames.items():
        yield ("frames", name), parts


def _frame_names(spec: Spec) -> Iterator[tuple[KeyPath, str, str]]:
    """Yield what the parts of each kind of frame become: fields, or constants of messages."""
    for path, parts in _frames(spec):
        ids = [name for name, part in parts.items() if isinstance(part, IdPart)]
        sent = [name for name in ids if getattr(parts[name], "sent", False)]
        yield from (
            ((*path, name), "field", name) for name, part in parts.items() if part.is_ in _GIVEN
        )
        yield from (((*path, name), "id", name.upper()) for name in ids if len(sent) > 1)


def _field_names(path: KeyPath, name: str, field: AnyField) -> Iterator[tuple[KeyPath, str, str]]:
    yield path, "field", name
    if not isinstance(field, ListField):
        yield from _named(path, name, field)
        return
    yield (*path, "element"), "element", field.element
    for inner, number in field.fields.items():
        here = (*path, "fields", inner)
        yield here, "field of an element", inner
        yield from _named(here, inner, number)


def _named(path: KeyPath, name: str, field: NumberField) -> Iterator[tuple[KeyPath, str, str]]:
    """Yield what the named values and the named bits of a number become."""
    for key in ("values", "bits"):
        for each in getattr(field, key):
            yield (*path, key, each), "constant", f"{name}_{each}".upper()
    for bit in field.bits:
        yield (*path, "bits", bit), "bits", f"{name}_{bit}"
