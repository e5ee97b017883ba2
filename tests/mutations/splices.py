"""What a spec takes from another: parts and kinds of frames, fields, messages and names.

Each splice changes the spec on the first desk, and says what it did. Whether the result is a spec
is for `framegen check` to say; each is made so that it often is.
"""

import re
from collections.abc import Callable
from functools import cache, partial
from typing import TypeAlias

from tests.factories import ROOT, Data
from tests.mutations.desk import Desk, Inapplicable, copied, inserted, renamed_in, reordered, varies

Splice: TypeAlias = Callable[[Desk, Desk], str]

# What is said of another message of the spec that a message comes from, or of its documents.
_OF_OTHERS = {"reply", "refusal", "reports", "echoed", "failure", "acknowledged", "lasts", "pose"}
_OF_OTHERS |= {"notes", "vendor_name", "since", "deprecated"}

# ---------------------------------------------------------------------------- parts of a frame


def _part(kind: str, host: Desk, donor: Desk) -> str:
    parts = host.pick(host.kinds.values())
    theirs, name = donor.part(lambda part: part["is"] == kind)
    if kind in ("length", "address", "counter") and _of_kind(parts, kind):
        raise Inapplicable
    new = name if name not in parts else host.fresh(name)
    names = [*theirs]
    in_front = names.index(name) < names.index(_of_kind(theirs, "body")[0])
    inserted(parts, _place(host, parts, in_front=in_front), new, _bare(theirs[name]))
    part = parts[new]
    if kind == "length":
        part["counts"] = _some(host, parts)
    elif kind == "checksum":
        part["covers"] = [each for each in _some(host, parts) if each != new]
    elif kind == "id":
        _give_ids(host, parts)
    return f"{kind} `{new}` as part {[*parts].index(new)} of its frame"


def _of_kind(parts: Data, kind: str) -> list[str]:
    return [name for name, part in parts.items() if part["is"] == kind]


def _place(host: Desk, parts: Data, *, in_front: bool) -> int:
    body = [*parts].index(_of_kind(parts, "body")[0])
    return host.chance.randint(0, body) if in_front else host.chance.randint(body + 1, len(parts))


def _some(host: Desk, parts: Data) -> list[str]:
    """Return some parts in their order, the body among them."""
    sent = {name: part for name, part in parts.items() if part.get("sent", True)}
    return [name for name, each in sent.items() if each["is"] == "body" or _likely(host)]


def _likely(host: Desk) -> bool:
    return host.chance.random() < 0.7


def _bare(thing: Data) -> Data:
    """Return a copy of a thing that cites no source of the spec that it comes from."""
    kept = {key: each for key, each in copied(thing).items() if key not in ("cite", "notes")}
    for key, value in kept.items():
        if isinstance(value, dict):
            inner = value.items()
            kept[key] = {n: _bare(each) if isinstance(each, dict) else each for n, each in inner}
    return kept


def _other_length(host: Desk, donor: Desk) -> str:
    parts, name = host.part(lambda part: part["is"] == "length")
    theirs, other = donor.part(lambda part: part["is"] == "length")
    parts[name] = {**_bare(theirs[other]), "counts": _some(host, parts)}
    return f"its length, of {theirs[other]['type']}, to count {', '.join(parts[name]['counts'])}"


def _other_checksum(host: Desk, donor: Desk) -> str:
    parts, name = host.part(lambda part: part["is"] == "checksum")
    theirs, other = donor.part(lambda part: part["is"] == "checksum")
    covers = [each for each in _some(host, parts) if each != name]
    parts[name] = {**_bare(theirs[other]), "covers": covers}
    return f"its checksum, to cover {', '.join(covers)}"


def _part_moved(host: Desk, donor: Desk) -> str:
    """Put a part where the other spec has one of the kind in front of which it stands."""
    parts = host.pick(host.kinds.values())
    roles = [part["is"] for part in donor.pick(donor.kinds.values()).values()]
    order = sorted(parts, key=lambda name: [*roles, parts[name]["is"]].index(parts[name]["is"]))
    if order == [*parts]:
        raise Inapplicable
    reordered(parts, order)
    return f"the order of its parts: {', '.join(order)}"


def _order(host: Desk, donor: Desk) -> str:
    host.spec["byte_order"] = donor.spec["byte_order"]
    return f"its byte order, {host.spec['byte_order']}"


# ---------------------------------------------------------------------------- messages and fields


def _message(host: Desk, donor: Desk) -> str:
    kind = host.pick(host.kinds)
    return _taken_message(host, donor, donor.pick(donor.messages), kind)


def _kind(host: Desk, donor: Desk) -> str:
    """Take a kind of frame with a message or two in it."""
    theirs = donor.pick(donor.kinds)
    names = [name for name, each in donor.messages.items() if _kind_of(donor, each) == theirs]
    if "frame" in host.spec:
        host.spec["frames"] = {"own": host.spec.pop("frame")}
        for message in host.messages.values():
            message["frame"] = "own"
    kind = host.fresh("other")
    host.spec["frames"][kind] = {name: _bare(part) for name, part in donor.kinds[theirs].items()}
    said = [_taken_message(host, donor, host.pick(names), kind) for _ in range(host.pick([1, 2]))]
    return f"a kind of frame with {' and '.join(said)}"


def _kind_of(desk: Desk, message: Data) -> str:
    return str(message.get("frame") or next(iter(desk.kinds)))


def _taken_message(host: Desk, donor: Desk, name: str, kind: str) -> str:
    theirs = donor.messages[name]
    fields = {each: _field_for(host, donor, theirs, each, kind) for each in theirs["fields"]}
    message = {key: value for key, value in _bare(theirs).items() if key not in _OF_OTHERS}
    message |= {"fields": fields, "examples": [], "direction": _way(host)}
    message["cite"] = host.spec["protocol"]["authority"]
    message.pop("method", None)
    message.pop("frame", None)
    if "frames" in host.spec:
        message["frame"] = kind
    new = name if name not in host.messages else host.fresh(name)
    host.messages[new] = message
    message.pop("id", None)
    _give_ids(host, host.kinds[kind])
    return f"the message {new}"


def _way(host: Desk) -> str:
    one, other, *_ = host.spec["endpoints"]
    return host.pick({f"{one} -> {other}", f"{other} -> {one}"})


def _give_ids(host: Desk, parts: Data) -> None:
    """Give each message of a kind of frame what it lacks of an id."""
    ids = _of_kind(parts, "id")
    for message in host.messages.values():
        if host.parts_of(message) is not parts or not ids:
            continue
        said = message.get("id", {})
        before = said if isinstance(said, dict) else {ids[0]: said}
        given = {name: before[name] if name in before else host.pick(_IDS) for name in ids}
        message["id"] = given if len(ids) > 1 else given[ids[0]]


_IDS = (1, 2, 3, 5, 9, 0x55, 0x80, 200, 254, 255)


def _field_for(host: Desk, donor: Desk, message: Data, name: str, kind: str) -> Data:
    """Return a field as a message of the host has it: with a length of its own frame."""
    field = _bare(message["fields"][name])
    if "element" in field and field["element"] in _class_names(host):
        field["element"] = host.fresh(field["element"])
    lengths = _of_kind(host.kinds[kind], "length")
    if field.get("sized_by") in _of_kind(donor.parts_of(message), "length"):
        if not lengths:
            raise Inapplicable
        field["sized_by"] = lengths[0]
    if field.get("optional") and not lengths:
        raise Inapplicable
    return field


def _field(host: Desk, donor: Desk) -> str:
    spot = donor.spot(lambda spot: not spot.inner)
    name = host.pick(host.messages)
    message = host.messages[name]
    fields = message["fields"]
    last = [each for each in fields if varies(fields[each]) or "optional" in fields[each]]
    is_last = varies(spot.field) or "optional" in spot.field
    if last and is_last:
        raise Inapplicable
    end = [*fields].index(last[0]) if last else len(fields)
    counters = {spot.field.get(key) for key in ("counted_by", "sized_by")} & spot.fields.keys()
    taken = {
        each: _field_for(host, donor, spot.message, each, _kind_of(host, message))
        for each in spot.fields
        if each == spot.name or each in counters
    }
    if taken.keys() & fields.keys():
        raise Inapplicable
    for number, (each, field) in enumerate(taken.items()):
        at = len(fields) if is_last else host.chance.randint(0, end + number)
        inserted(fields, at, each, field)
    message.pop("method", None)
    return f"the field `{spot.name}` in {name}"


def _element_field(host: Desk, donor: Desk) -> str:
    """Put a number into the elements of a list."""
    spot = donor.spot(lambda spot: "type" in spot.field and not varies(spot.field))
    around = host.spot(lambda spot: "fields" in spot.field)
    fields = around.field["fields"]
    if spot.name in fields or "optional" in spot.field:
        raise Inapplicable
    inserted(fields, host.chance.randint(0, len(fields)), spot.name, _bare(spot.field))
    return f"the field `{spot.name}` in the elements of `{around.name}`"


# ---------------------------------------------------------------------------- names

_RUNTIME = ROOT / "runtime" / "framewire"
_CLASS = re.compile(r"^class ([A-Z]\w+)", re.MULTILINE)
# Whatever a spec may call something, and what is called something in a library.
_WORDS = (
    *("class", "type", "id", "self", "len", "match", "frame", "values", "name", "data", "size"),
    *("encode", "decode", "direction", "offset", "message", "struct", "kind", "fields", "at"),
)


@cache
def _helpers() -> list[str]:
    """Return the names of all classes that are in a library whatever its spec is."""
    texts = (file.read_text(encoding="utf-8") for file in sorted(_RUNTIME.rglob("*.py")))
    return sorted({name for text in texts for name in _CLASS.findall(text)})


def _class_names(desk: Desk) -> set[str]:
    elements = {spot.field["element"] for spot in desk.spots() if "element" in spot.field}
    return {*desk.messages, *elements}


def _small_names(desk: Desk) -> set[str]:
    """Return whatever has a name in a spec that is no class."""
    parts = {name for kind in desk.kinds.values() for name in kind}
    fields = {spot.name for spot in desk.spots()}
    named = (spot.field.get(key, ()) for spot in desk.spots() for key in ("values", "bits"))
    values = {name for names in named for name in names}
    return {*parts, *fields, *values, *desk.spec["endpoints"], *desk.kinds}


def _word(host: Desk, donor: Desk) -> str:
    ours, theirs = _small_names(host), _small_names(donor)
    return host.pick(host.pick([ours, ours, theirs, _WORDS]))


def _class_word(host: Desk, donor: Desk) -> str:
    return host.pick(host.pick([_helpers(), _helpers(), _class_names(host), _class_names(donor)]))


def _field_called(host: Desk, donor: Desk) -> str:
    spot, new = host.spot(lambda _: True), _word(host, donor)
    if new in spot.fields:
        raise Inapplicable
    host.rename_field(spot, new, said=False)
    return f"the name `{new}` for its field `{spot.name}`"


def _part_called(host: Desk, donor: Desk) -> str:
    parts, old = host.part(lambda _: True)
    new = _word(host, donor)
    if new in parts:
        raise Inapplicable
    host.rename_part(parts, old, new)
    for message in host.messages.values():
        if host.parts_of(message) is not parts:
            continue
        if isinstance(message.get("id"), dict):
            renamed_in(message["id"], old, new)
        for field in message["fields"].values():
            if field.get("sized_by") == old:
                field["sized_by"] = new
    return f"the name `{new}` for its part `{old}`"


def _message_called(host: Desk, donor: Desk) -> str:
    old, new = host.pick(host.messages), _class_word(host, donor)
    if new in host.messages:
        raise Inapplicable
    host.rename_message(old, new, said=False)
    return f"the name {new} for its message {old}"


def _element_called(host: Desk, donor: Desk) -> str:
    field, new = host.spot(lambda spot: "element" in spot.field).field, _class_word(host, donor)
    old, field["element"] = field["element"], new
    return f"the name {new} for its elements {old}"


def _value_called(host: Desk, donor: Desk) -> str:
    key = host.pick(["values", "bits"])
    named = host.spot(lambda spot: spot.field.get(key)).field[key]
    old, new = host.pick(named), _word(host, donor)
    if new in named:
        raise Inapplicable
    renamed_in(named, old, new)
    return f"the name `{new}` for its value `{old}`"


SPLICES: dict[str, Splice] = {
    **{
        kind: partial(_part, kind)
        for kind in ("constant", "reserved", "address", "counter", "checksum", "id", "length")
    },
    "another length": _other_length,
    "another checksum": _other_checksum,
    "order of parts": _part_moved,
    "byte order": _order,
    "message": _message,
    "kind": _kind,
    "field": _field,
    "field of an element": _element_field,
    "name of a field": _field_called,
    "name of a part": _part_called,
    "name of a message": _message_called,
    "name of an element": _element_called,
    "name of a value": _value_called,
}
