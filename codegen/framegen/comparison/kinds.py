"""Compare two versions of a spec and classify each change by what it breaks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import (
    AddressPart,
    BodyPart,
    ChecksumPart,
    ConstantPart,
    IdPart,
    LengthPart,
    ListField,
    ReservedPart,
)
from framegen.language.values import Direction, to_hex
from framegen.model.exchanges import method_of
from framegen.model.slots import Constant, Items, Number, Packed, Text

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.language.spec import (
        Frame,
        FramePart,
        Limits,
        Link,
        Message,
        NumberField,
        NumberPart,
        Pose,
    )
    from framegen.language.values import Range
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import MessageSlot

Breaks: TypeAlias = Literal["wire", "programs", "nothing"]
# A field that is no list of elements.
_Single: TypeAlias = "Number | Text | Packed | Constant"

# Every kind of difference. `wire`: an end that knows the old edition and one that knows the new
# misread each other, or refuse what the other sends. `programs`: what was written for the old
# library may not run with the new one. Names of kinds are for programs to rely on, and stay.
KINDS: dict[str, Breaks] = {
    "byte-order": "wire",
    "frame": "wire",
    "frame-added": "nothing",
    "frame-removed": "nothing",
    "address-silent": "programs",
    "link": "wire",
    "hid-added": "nothing",
    "hid-removed": "programs",
    "hid-report": "wire",
    "version": "nothing",
    "library-renamed": "programs",
    "endpoint-renamed": "programs",
    "client-changed": "programs",
    "message-added": "nothing",
    "message-removed": "wire",
    "message-renamed": "programs",
    "message-id": "wire",
    "message-direction": "wire",
    "message-frame": "wire",
    "message-lengths": "wire",
    "message-reply": "wire",
    "message-refusal": "programs",
    "message-failure": "programs",
    "message-deprecated": "nothing",
    "method-renamed": "programs",
    "method-arguments": "programs",
    "method-result": "programs",
    "result-tells-more": "nothing",
    "result-tells-less": "programs",
    "field-added": "wire",
    "field-removed": "wire",
    "field-renamed": "programs",
    "field-order": "wire",
    "field-type": "wire",
    "field-unit": "wire",
    "field-optional": "wire",
    "list-length": "wire",
    "count-renamed": "nothing",
    "element": "programs",
    "range-narrowed": "wire",
    "range-widened": "nothing",
    "limits-narrowed": "programs",
    "limits-widened": "nothing",
    "property-added": "nothing",
    "property-changed": "programs",
    "property-removed": "programs",
    "pose-added": "nothing",
    "pose-changed": "programs",
    "pose-removed": "programs",
    "value-added": "nothing",
    "value-removed": "programs",
    "value-renamed": "programs",
    "value-changed": "wire",
    "bit-added": "nothing",
    "bit-removed": "programs",
    "bit-renamed": "programs",
    "bit-changed": "wire",
    "example-added": "nothing",
    "example-removed": "nothing",
    "words": "nothing",
}


# What a spec says besides the protocol itself.
_SECTIONS = ("sources", "reserved", "errata", "unknowns", "lookalikes", "history")


@dataclass(frozen=True, slots=True)
class Difference:
    """One change, at its path in the new version, or in the old where it was removed."""

    kind: str
    path: str
    old: str | None = None
    new: str | None = None

    @property
    def breaks(self) -> Breaks:
        """What the change breaks."""
        return KINDS[self.kind]

    def __str__(self) -> str:
        if self.kind == "words":
            return "is said otherwise"
        if self.old is None:
            return f"{self.new} is new"
        return f"{self.old} is gone" if self.new is None else f"{self.old} became {self.new}"


def differences(old: Model, new: Model) -> list[Difference]:
    """Return all changes from one version to the next, in the order of the new spec."""
    return [
        *_line(old, new),
        *_messages(old, new),
        *_pose(old.spec.pose, new.spec.pose),
        *_said_of_all(old, new),
    ]


def _line(old: Model, new: Model) -> Iterator[Difference]:
    """Compare what all messages share: library, endpoints, link and envelope."""
    was, now = old.spec, new.spec
    versions = was.protocol.version, now.protocol.version
    yield from _changed("version", "protocol.version", *versions)
    yield from _changed("library-renamed", "protocol.name", was.protocol.name, now.protocol.name)
    ends = _renamed_ends(old, new)
    for one, other in ends.items():
        yield from _changed("endpoint-renamed", f"endpoints.{other}", one, other)
    client = ends.get(old.roles.client, old.roles.client)
    yield from _changed("client-changed", "endpoints", client, new.roles.client)
    for name in ("baud", "data_bits", "parity", "stop_bits", "local_echo"):
        settings = getattr(was.link, name), getattr(now.link, name)
        yield from _changed("link", f"link.{name}", *settings)
    yield from _hid(was.link, now.link)
    yield from _changed("byte-order", "byte_order", was.byte_order, now.byte_order)
    yield from _frames(old, new)


def _frames(old: Model, new: Model) -> Iterator[Difference]:
    """Compare the kinds of frames, which are identified by their parts."""
    was, now, names = old.spec.envelopes, new.spec.envelopes, _renamed_frames(old, new)
    before = {names.get(name, name): name for name in was}
    for name, frame in now.items():
        path = f"frames.{name}" if new.spec.frames else "frame"
        if name not in before:
            yield Difference("frame-added", path, None, _envelope(frame))
            continue
        earlier = was[before[name]]
        yield from _changed("frame", path, _envelope(earlier), _envelope(frame))
        yield from _given_parts(path, earlier, frame)
    for name, called in before.items():
        if name not in now:
            yield Difference("frame-removed", f"frames.{called}", _envelope(was[called]))


def _given_parts(path: str, old: Frame, new: Frame) -> Iterator[Difference]:
    """Compare those parts that a user gives or is given by name."""
    for kind in ("address", "counter"):
        was, now = (
            next(((name, part) for name, part in frame.items() if part.is_ == kind), None)
            for frame in (old, new)
        )
        if was is None or now is None:
            continue
        yield from _changed("field-renamed", f"{path}.{now[0]}", was[0], now[0])
        if isinstance(was[1], AddressPart) and isinstance(now[1], AddressPart):
            yield from _addresses(f"{path}.{now[0]}", was[1], now[1])
    ids = [[name for name, part in frame.items() if part.is_ == "id"] for frame in (old, new)]
    if len(ids[0]) == len(ids[1]) > 1:
        for one, other in zip(*ids, strict=True):
            yield from _changed("field-renamed", f"{path}.{other}", one, other)


def _addresses(path: str, old: AddressPart, new: AddressPart) -> Iterator[Difference]:
    if old.type == new.type:
        was, now = (
            (0 if each.range is None else each.range.low, _highest(each)) for each in (old, new)
        )
        yield from _range(f"{path}.range", was, now)
    values = [{name: each.value for name, each in part.values.items()} for part in (old, new)]
    yield from _named(f"{path}.values", "value", *values)
    for name in old.values.keys() & new.values.keys():
        silent = old.values[name].silent, new.values[name].silent
        yield from _changed("address-silent", f"{path}.values.{name}.silent", *silent)


def _highest(part: AddressPart) -> int:
    highest = NUMBER_TYPES[part.type].high
    return highest if part.range is None or part.range.high is None else part.range.high


def _hid(old: Link, new: Link) -> Iterator[Difference]:
    """Compare USB HID boards, which are identified by vendor and product."""
    path = "link.usb_hid"
    was, now = ({board.ids: board for board in link.usb_hid} for link in (old, new))
    for ids, board in now.items():
        if ids in was:
            sizes = was[ids].report_size, board.report_size
            yield from _changed("hid-report", f"{path}.report_size", *sizes)
        else:
            yield Difference("hid-added", path, None, ids)
    yield from (Difference("hid-removed", path, ids) for ids in was if ids not in now)


def _messages(old: Model, new: Model) -> Iterator[Difference]:
    ends = _renamed_ends(old, new)
    names = _renamed(
        {name: _identity(message, ends) for name, message in old.messages.items()},
        {name: _identity(message, {}) for name, message in new.messages.items()},
    )
    before = {names.get(name, name): message for name, message in old.messages.items()}
    kinds = _renamed_frames(old, new)
    for name, message in new.messages.items():
        path = f"messages.{name}"
        if name not in before:
            yield Difference("message-added", path, None, name)
            continue
        was = before[name]
        yield from _changed("message-renamed", path, was.name, name)
        yield from _changed("message-id", f"{path}.id", _ids(was), _ids(message))
        frame = kinds.get(was.frame.name, was.frame.name)
        yield from _changed("message-frame", f"{path}.frame", frame, message.frame.name)
        way = _seen(was.direction, ends)
        yield from _changed("message-direction", f"{path}.direction", way, message.direction)
        yield from _exchange(path, was, message, names)
        if was.optional and message.optional:
            lengths = was.formula, message.formula
            yield from _changed("message-lengths", f"{path}.length", *lengths)
        yield from _fields(f"{path}.fields", _singles(was.body), _singles(message.body))
        yield from _lists(f"{path}.fields", was.body, message.body)
        if was.direction == old.roles.sent and message.direction == new.roles.sent:
            yield from _method(f"{path}.method", was, message)
            yield from _result(path, was, message, names)
        yield from _remarks(path, was.message, message.message)
    for name, message in before.items():
        if name not in new.messages:
            yield Difference("message-removed", f"messages.{message.name}", message.name)


def _exchange(
    path: str, old: MessageLayout, new: MessageLayout, names: Mapping[str, str]
) -> Iterator[Difference]:
    """Compare what answers a message, and which field of it says that something has failed."""
    for key in ("reply", "refusal"):
        was, now = getattr(old.message, key), getattr(new.message, key)
        yield from _changed(f"message-{key}", f"{path}.{key}", names.get(was, was), now)
    fields = _renamed_fields(_singles(old.body), _singles(new.body))
    was, now = old.message.failure, new.message.failure
    was = None if was is None else fields.get(was, was)
    yield from _changed("message-failure", f"{path}.failure", was, now)


def _method(path: str, old: MessageLayout, new: MessageLayout) -> Iterator[Difference]:
    was, now = method_of(old.name, old.message), method_of(new.name, new.message)
    yield from _changed("method-renamed", path, was.name, now.name)
    arguments = ", ".join(was.arguments), ", ".join(now.arguments)
    yield from _changed("method-arguments", path, *(f"({each})" for each in arguments))
    yield from _changed("method-result", path, was.result or None, now.result or None)


def _result(
    path: str, old: MessageLayout, new: MessageLayout, names: Mapping[str, str]
) -> Iterator[Difference]:
    """Compare what the result of a command reports besides that it was sent."""
    fields = _renamed_fields(_singles(old.body), _singles(new.body))
    for key, renamed in (("acknowledged", names), ("lasts", fields)):
        was, now = getattr(old.message, key), getattr(new.message, key)
        was = renamed.get(was, was)
        kind = "result-tells-more" if was is None else "result-tells-less"
        yield from _changed(kind, f"{path}.{key}", was, now)


def _fields(path: str, old: tuple[_Single, ...], new: tuple[_Single, ...]) -> Iterator[Difference]:
    """Compare the fields of a message, or of an element of its list, one behind the other."""
    names = _renamed_fields(old, new)
    before = {names.get(field.name, field.name): field for field in old}
    for field in new:
        here = f"{path}.{field.name}"
        if field.name not in before:
            yield Difference("field-added", here, None, _type(field))
            continue
        was = before[field.name]
        is_count = isinstance(field, Number) and field.counts
        kind = "count-renamed" if is_count else "field-renamed"
        yield from _changed(kind, here, was.name, field.name)
        yield from _single(here, was, field)
    after = [field.name for field in new]
    for name, was in before.items():
        if name not in after:
            yield Difference("field-removed", f"{path}.{was.name}", _type(was))
    kept = [name for name in before if name in after]
    order = [name for name in after if name in before]
    yield from _changed("field-order", path, ", ".join(kept), ", ".join(order))
    yield from _properties(path, [*before.values()], [*new])


def _type(field: _Single) -> str:
    """Return what stands on the wire for a field, in words."""
    match field:
        case Number():
            return field.number_type.name
        case Text():
            return f"{field.charset} text of {field.size}"
        case Packed():
            return f"{field.count} of {field.number_type.name}"
        case Constant():
            return f"{field.role} {to_hex(field.data)}"


def _single(path: str, old: _Single, new: _Single) -> Iterator[Difference]:
    if isinstance(old, Number) and isinstance(new, Number):
        yield from _number(path, old, new)
        yield from _changed("field-optional", f"{path}.optional", old.optional, new.optional)
        return
    yield from _changed("field-type", f"{path}.type", _type(old), _type(new))
    if isinstance(old, Packed) and isinstance(new, Packed):
        yield from _changed("byte-order", f"{path}.byte_order", old.order, new.order)
        if old.number_type == new.number_type:
            yield from _range(f"{path}.range", (old.low, old.high), (new.low, new.high))
        yield from _units(path, old.field, new.field)


def _properties(path: str, old: list[_Single], new: list[_Single]) -> Iterator[Difference]:
    """Compare the properties that a message or an element has besides its numbers."""
    was, now = _properties_of(old), _properties_of(new)
    for name in dict.fromkeys([*was, *now]):
        here = f"{path}.{name}"
        if name not in was:
            yield Difference("property-added", here, None, now[name])
        elif name not in now:
            yield Difference("property-removed", here, was[name])
        else:
            yield from _changed("property-changed", here, was[name], now[name])


def _properties_of(fields: Iterable[_Single]) -> dict[str, str]:
    """Return each such property by its name, with what it is computed from."""
    found: dict[str, str] = {}
    for each in (field for field in fields if isinstance(field, Number)):
        if each.field.signed_as is not None:
            found[f"signed_{each.name}"] = each.field.signed_as
        values = [str(named.value) for named in each.field.values.values() if named.absent]
        if values:
            found["absent"] = " or ".join(values)
    return found


def _limits(path: str, old: Limits | None, new: Limits | None) -> Iterator[Difference]:
    was, now = (None if each is None else each.usual for each in (old, new))
    if was != now:
        wider = now is None or (was is not None and now.holds(was))
        kind = "limits-widened" if wider else "limits-narrowed"
        yield from _changed(kind, path, was, now)


def _pose(old: Pose | None, new: Pose | None) -> Iterator[Difference]:
    """Compare the methods and verbs that read and command positions."""
    if old is None or new is None:
        if new is not None:
            yield Difference("pose-added", "pose", None, f"{new.hold}, {new.present}")
        if old is not None:
            yield Difference("pose-removed", "pose", f"{old.hold}, {old.present}")
        return
    for name in type(new).model_fields:
        yield from _changed("pose-changed", f"pose.{name}", getattr(old, name), getattr(new, name))


def _number(path: str, old: Number, new: Number) -> Iterator[Difference]:
    if old.number_type != new.number_type:
        yield Difference("field-type", f"{path}.type", old.number_type.name, new.number_type.name)
    else:
        # The order of the whole protocol is compared as a whole.
        orders = old.field.byte_order, new.field.byte_order
        yield from _changed("byte-order", f"{path}.byte_order", *orders)
        yield from _range(f"{path}.range", (old.low, old.high), (new.low, new.high))
    yield from _units(path, old.field, new.field)
    yield from _limits(f"{path}.limits", old.field.limits, new.field.limits)
    values = [
        {name: value.value for name, value in each.field.values.items()} for each in (old, new)
    ]
    yield from _named(f"{path}.values", "value", *values)
    bits = [{name: _bits(bits.at) for name, bits in each.field.bits.items()} for each in (old, new)]
    yield from _named(f"{path}.bits", "bit", *bits)


def _bits(at: Range) -> str:
    return str(at.low) if at.low == at.high else str(at)


def _units(path: str, old: NumberField, new: NumberField) -> Iterator[Difference]:
    for name in ("unit", "scale"):
        was, now = getattr(old, name), getattr(new, name)
        yield from _changed("field-unit", f"{path}.{name}", was or None, now or None)


def _named(
    path: str, what: str, old: Mapping[str, object], new: Mapping[str, object]
) -> Iterator[Difference]:
    """Compare numbers with a name: values, or bits."""
    names = _renamed(old, new)
    before = {names.get(name, name): (name, value) for name, value in old.items()}
    for name, value in new.items():
        if name not in before:
            yield Difference(f"{what}-added", f"{path}.{name}", None, str(value))
            continue
        yield from _changed(f"{what}-renamed", f"{path}.{name}", before[name][0], name)
        yield from _changed(f"{what}-changed", f"{path}.{name}", before[name][1], value)
    for name, (called, value) in before.items():
        if name not in new:
            yield Difference(f"{what}-removed", f"{path}.{called}", str(value))


def _lists(
    path: str, old: tuple[MessageSlot, ...], new: tuple[MessageSlot, ...]
) -> Iterator[Difference]:
    """Compare the lists of a message, one behind the other."""
    was, now = ([slot for slot in each if isinstance(slot, Items)] for each in (old, new))
    names = _renamed(
        *({slot.name: at for at, slot in enumerate(each)} for each in (was, now)),
    )
    before = {names.get(slot.name, slot.name): slot for slot in was}
    after = {slot.name: slot for slot in now}
    for name in dict.fromkeys([*before, *after]):
        yield from _list(path, before.get(name), after.get(name))
    kept, order = [name for name in before if name in after], [*after]
    order = [name for name in order if name in before]
    yield from _changed("field-order", path, ", ".join(kept), ", ".join(order))


def _list(path: str, old: Items | None, new: Items | None) -> Iterator[Difference]:
    if old is None or new is None:
        if new is not None:
            yield Difference("field-added", f"{path}.{new.name}", None, "a list")
        if old is not None:
            yield Difference("field-removed", f"{path}.{old.name}", "a list")
        return
    here = f"{path}.{new.name}"
    yield from _changed("field-renamed", here, old.name, new.name)
    yield from _changed("element", f"{here}.element", old.element, new.element)
    yield from _changed("list-length", here, _said_by(old), _said_by(new))
    yield from _changed("field-type", f"{here}.text", old.text, new.text)
    yield from _range(f"{here}.count", (old.low, old.high), (new.low, new.high))
    one, other = old.slots[0], new.slots[0]
    if old.element is None and new.element is None:
        yield from _single(here, one, other)
    else:
        yield from _fields(f"{here}.fields", old.slots, new.slots)


def _said_by(items: Items) -> str:
    """Return what says how long a list is, in words."""
    if items.is_fixed:
        return "always as long"
    said = [("counted_by", "counted"), ("sized_by", "sized")]
    ways = [word for key, word in said if getattr(items.field, key) is not None]
    return " and ".join(ways if items.counter is not None else ["as long as the frame"])


def _range(path: str, old: tuple[int, int], new: tuple[int, int]) -> Iterator[Difference]:
    wider = new[0] <= old[0] and old[1] <= new[1]
    kind = "range-widened" if wider else "range-narrowed"
    yield from _changed(kind, path, *(f"{low}..{high}" for low, high in (old, new)))


def _remarks(path: str, old: Message, new: Message) -> Iterator[Difference]:
    """Compare what neither bytes nor programs depend on."""
    yield from _changed(
        "message-deprecated", f"{path}.deprecated", old.deprecated or None, new.deprecated or None
    )
    was = {example.hex: example for example in old.examples}
    now = {example.hex: example for example in new.examples}
    for hex_ in now.keys() - was.keys():
        yield Difference("example-added", f"{path}.examples", None, to_hex(hex_))
    for hex_ in was.keys() - now.keys():
        yield Difference("example-removed", f"{path}.examples", to_hex(hex_))
    said, says = _prose(old), _prose(new)
    if any(said[what] != says[what] for what in said.keys() & says.keys()):
        yield Difference("words", path)


def _prose(message: Message) -> dict[object, object]:
    """Return the prose of a message, and of its fields, named values and examples."""
    said: dict[object, object] = {
        "message": (message.vendor_name, message.summary, message.description, message.cite),
        "versions": message.since,
        "exchange": (message.echoed, message.reports),
        **{each.hex: (each.title, each.cite, each.constructed) for each in message.examples},
    }
    for name, field in message.fields.items():
        said[name] = (field.about, field.notes, field.cite)
        inner = field.fields if isinstance(field, ListField) else {"": field}
        for key, number in inner.items():
            others = None if number.limits is None else number.limits.others
            said[name, key] = (number.about, number.notes, number.cite, others)
            for word, value in number.values.items():
                said[name, key, word] = (value.about, value.cite)
            for word, bits in number.bits.items():
                said[name, key, "bits", word] = bits.about
    return said


def _said_of_all(old: Model, new: Model) -> Iterator[Difference]:
    """Compare the sections that belong to no message."""
    was, now = (
        {
            "protocol": each.protocol.model_copy(update={"name": "", "version": ""}),
            "endpoints": list(each.endpoints.values()),
            "link": (
                each.link.cite,
                {board.ids: (board.about, board.cite) for board in each.link.usb_hid},
            ),
            "frame": [
                (part.about, _addresses_in_words(part))
                for frame in each.envelopes.values()
                for part in frame.values()
            ],
            **{name: getattr(each, name) for name in _SECTIONS},
        }
        for each in (old.spec, new.spec)
    )
    yield from (Difference("words", name) for name in was if was[name] != now[name])


def _changed(kind: str, path: str, old: object, new: object) -> Iterator[Difference]:
    if old != new:
        was, now = (None if each is None else str(each) for each in (old, new))
        yield Difference(kind, path, was, now)


def _renamed(old: Mapping[str, object], new: Mapping[str, object]) -> dict[str, str]:
    """Match old names with new ones of the same content, where neither version has both."""
    gone = [name for name in old if name not in new]
    come = [name for name in new if name not in old]
    found: dict[str, str] = {}
    for name in gone:
        same = [each for each in come if new[each] == old[name] and each not in found.values()]
        if same:
            found[name] = same[0]
    return found


def _singles(slots: Iterable[MessageSlot]) -> tuple[_Single, ...]:
    """Return the fields that are no lists of elements."""
    return tuple(slot for slot in slots if not isinstance(slot, Items))


def _renamed_fields(old: tuple[_Single, ...], new: tuple[_Single, ...]) -> dict[str, str]:
    places = (
        {field.name: (at, _type(field)) for at, field in enumerate(each)} for each in (old, new)
    )
    return _renamed(*places)


def _renamed_frames(old: Model, new: Model) -> dict[str, str]:
    was, now = (
        {name: _envelope(frame) for name, frame in each.spec.envelopes.items()}
        for each in (old, new)
    )
    if len(was) == len(now) == 1:
        return dict(zip(was, now, strict=True))
    return _renamed(was, now)


def _renamed_ends(old: Model, new: Model) -> dict[str, str]:
    places = ({name: at for at, name in enumerate(each.spec.endpoints)} for each in (old, new))
    return _renamed(*places)


def _seen(way: Direction, ends: Mapping[str, str]) -> Direction:
    """Return a direction with the new names of its endpoints."""
    return Direction(*(ends.get(end, end) for end in (way.sender, way.receiver)))


def _identity(message: MessageLayout, ends: Mapping[str, str]) -> object:
    """Return what identifies a message whatever its name: its frame."""
    slots = tuple(
        tuple(map(_type, slot.slots)) if isinstance(slot, Items) else _type(slot)
        for slot in message.body
    )
    return message.ids, _envelope_of(message), _seen(message.direction, ends), slots


def _envelope_of(message: MessageLayout) -> object:
    return [(slot.role, slot.size) for slot in (*message.frame.head, *message.frame.tail)]


def _ids(message: MessageLayout) -> str | None:
    return ", ".join(map(str, message.ids)) or None


def _envelope(parts: Frame) -> str:
    """Describe the parts of a frame without their names: `55 55, u8 length of 2 and 3, ...`."""
    return ", ".join(_part(part, [*parts]) for part in parts.values())


def _part(part: FramePart, names: Iterable[str]) -> str:
    match part:
        case ConstantPart():
            return to_hex(part.bytes_)
        case ReservedPart():
            return f"reserved {to_hex(part.bytes_)}"
        case BodyPart():
            return part.is_
        case _:
            return _number_part(part, names)


def _number_part(part: NumberPart, names: Iterable[str]) -> str:
    order = "" if part.byte_order is None else f" {part.byte_order}"
    words = f"{part.is_} {part.type}{order}"
    match part:
        case LengthPart():
            return f"{words} of part {_places(part.counts, names)}"
        case ChecksumPart():
            places = {name: str(at) for at, name in enumerate(names, 1)}
            covered = " and ".join(places.get(name, "?") for name in part.covers)
            return f"{words} {part.method} of part {covered}"
        case IdPart(sent=False):
            return f"{words} not sent"
        case _:
            return words


def _places(counted: Iterable[str], names: Iterable[str]) -> str:
    counted = set(counted)
    return " and ".join(str(at) for at, name in enumerate(names, 1) if name in counted)


def _addresses_in_words(part: FramePart) -> object:
    """Return what is said of the addresses of a name."""
    if not isinstance(part, AddressPart):
        return None
    return {name: (each.about, each.cite) for name, each in part.values.items()}
