"""Compare two versions of a spec and classify each change by what it breaks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeAlias

from framegen.language.spec import ConstantPart, IdPart, LengthPart, ListField
from framegen.language.values import Direction, to_hex
from framegen.model.exchanges import method_of
from framegen.model.slots import Number

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.language.spec import FramePart, Limits, Link, Message, Pose
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Items

Breaks: TypeAlias = Literal["wire", "programs", "nothing"]

# Every kind of difference. `wire`: an end that knows the old edition and one that knows the new
# misread each other, or refuse what the other sends. `programs`: what was written for the old
# library may not run with the new one. Names of kinds are for programs to rely on, and stay.
KINDS: dict[str, Breaks] = {
    "byte-order": "wire",
    "frame": "wire",
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
    "message-reply": "wire",
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
    for name in ("baud", "data_bits", "parity", "stop_bits"):
        settings = getattr(was.link, name), getattr(now.link, name)
        yield from _changed("link", f"link.{name}", *settings)
    yield from _hid(was.link, now.link)
    yield from _changed("byte-order", "byte_order", was.byte_order, now.byte_order)
    yield from _changed("frame", "frame", _envelope(was.frame), _envelope(now.frame))


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
    for name, message in new.messages.items():
        path = f"messages.{name}"
        if name not in before:
            yield Difference("message-added", path, None, name)
            continue
        was = before[name]
        yield from _changed("message-renamed", path, was.name, name)
        yield from _changed("message-id", f"{path}.id", was.id, message.id)
        way = _seen(was.direction, ends)
        yield from _changed("message-direction", f"{path}.direction", way, message.direction)
        reply = was.message.reply
        reply = None if reply is None else names.get(reply, reply)
        yield from _changed("message-reply", f"{path}.reply", reply, message.message.reply)
        yield from _fields(f"{path}.fields", _numbers(was), _numbers(message))
        yield from _list(f"{path}.fields", was.items, message.items)
        if was.direction == old.roles.sent and message.direction == new.roles.sent:
            yield from _method(f"{path}.method", was, message)
            yield from _result(path, was, message, names)
        yield from _remarks(path, was.message, message.message)
    for name, message in before.items():
        if name not in new.messages:
            yield Difference("message-removed", f"messages.{message.name}", message.name)


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
    fields = _renamed_fields(_numbers(old), _numbers(new))
    for key, renamed in (("acknowledged", names), ("lasts", fields)):
        was, now = getattr(old.message, key), getattr(new.message, key)
        was = renamed.get(was, was)
        kind = "result-tells-more" if was is None else "result-tells-less"
        yield from _changed(kind, f"{path}.{key}", was, now)


def _fields(path: str, old: tuple[Number, ...], new: tuple[Number, ...]) -> Iterator[Difference]:
    """Compare the numbers of a message, or of an element of its list, one behind the other."""
    names = _renamed_fields(old, new)
    before = {names.get(field.name, field.name): field for field in old}
    for field in new:
        here = f"{path}.{field.name}"
        if field.name not in before:
            yield Difference("field-added", here, None, field.number_type.name)
            continue
        was = before[field.name]
        kind = "count-renamed" if field.role == "count" else "field-renamed"
        yield from _changed(kind, here, was.name, field.name)
        yield from _number(here, was, field)
    after = [field.name for field in new]
    for name, was in before.items():
        if name not in after:
            yield Difference("field-removed", f"{path}.{was.name}", was.number_type.name)
    kept = [name for name in before if name in after]
    order = [name for name in after if name in before]
    yield from _changed("field-order", path, ", ".join(kept), ", ".join(order))
    yield from _properties(path, [*before.values()], [*new])


def _properties(path: str, old: list[Number], new: list[Number]) -> Iterator[Difference]:
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


def _properties_of(fields: Iterable[Number]) -> dict[str, str]:
    """Return each such property by its name, with what it is computed from."""
    found: dict[str, str] = {}
    for each in fields:
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
        yield from _range(f"{path}.range", (old.low, old.high), (new.low, new.high))
    for name in ("unit", "scale"):
        was, now = getattr(old.field, name), getattr(new.field, name)
        yield from _changed("field-unit", f"{path}.{name}", was or None, now or None)
    yield from _limits(f"{path}.limits", old.field.limits, new.field.limits)
    yield from _values(f"{path}.values", old, new)


def _values(path: str, old: Number, new: Number) -> Iterator[Difference]:
    was = {name: value.value for name, value in old.field.values.items()}
    now = {name: value.value for name, value in new.field.values.items()}
    names = _renamed(was, now)
    before = {names.get(name, name): (name, value) for name, value in was.items()}
    for name, value in now.items():
        if name not in before:
            yield Difference("value-added", f"{path}.{name}", None, str(value))
            continue
        yield from _changed("value-renamed", f"{path}.{name}", before[name][0], name)
        yield from _changed("value-changed", f"{path}.{name}", before[name][1], value)
    for name, (called, value) in before.items():
        if name not in now:
            yield Difference("value-removed", f"{path}.{called}", str(value))


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
    yield from _range(f"{here}.count", (old.low, old.high), (new.low, new.high))
    if old.element is None and new.element is None:
        yield from _number(here, old.fields[0], new.fields[0])
    else:
        yield from _fields(f"{here}.fields", old.fields, new.fields)


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
            "frame": [part.about for part in each.frame.values()],
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


def _numbers(message: MessageLayout) -> tuple[Number, ...]:
    return tuple(slot for slot in message.fields if isinstance(slot, Number))


def _renamed_fields(old: tuple[Number, ...], new: tuple[Number, ...]) -> dict[str, str]:
    places = (
        {field.name: (at, field.number_type) for at, field in enumerate(each)}
        for each in (old, new)
    )
    return _renamed(*places)


def _renamed_ends(old: Model, new: Model) -> dict[str, str]:
    places = ({name: at for at, name in enumerate(each.spec.endpoints)} for each in (old, new))
    return _renamed(*places)


def _seen(way: Direction, ends: Mapping[str, str]) -> Direction:
    """Return a direction with the new names of its endpoints."""
    return Direction(*(ends.get(end, end) for end in (way.sender, way.receiver)))


def _identity(message: MessageLayout, ends: Mapping[str, str]) -> object:
    """Return what identifies a message whatever its name: its frame."""
    numbers = tuple(field.number_type for field in _numbers(message))
    listed = () if message.items is None else tuple(f.number_type for f in message.items.fields)
    return message.id, _seen(message.direction, ends), numbers, listed


def _envelope(parts: Mapping[str, FramePart]) -> str:
    """Describe the parts of a frame without their names: `55 55, u8 length of 2 and 3, ...`."""
    return ", ".join(_part(part, [*parts]) for part in parts.values())


def _part(part: FramePart, names: Iterable[str]) -> str:
    if isinstance(part, ConstantPart):
        return to_hex(part.bytes_)
    if isinstance(part, LengthPart):
        counted = [str(at) for at, name in enumerate(names, 1) if name in part.counts]
        return f"length {part.type} of part {' and '.join(counted)}"
    return f"{part.is_} {part.type}" if isinstance(part, IdPart) else part.is_
