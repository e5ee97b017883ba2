"""MAVLink's message definitions, read from their XML, and the spec that says the same in YAML.

What a spec cannot say of them: the parameters of a `MAV_CMD` mean another thing for each command;
a MAVLink 2 frame is sent without the zeros at its end, and may be signed. So this is MAVLink 1:
messages with an id of at most 255, without their extensions, which it does not carry either.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any
from xml.etree import ElementTree as ET

# The types of a definition, each with that of a spec and its size.
TYPES = {
    "char": ("u8", 1),
    "uint8_t": ("u8", 1),
    "int8_t": ("i8", 1),
    "uint16_t": ("u16", 2),
    "int16_t": ("i16", 2),
    "uint32_t": ("u32", 4),
    "int32_t": ("i32", 4),
    "uint64_t": ("u64", 8),
    "int64_t": ("i64", 8),
    "float": ("f32", 4),
    "double": ("f64", 8),
}
_LIMIT = re.compile(r"(U?)INT(8|16|32|64)_MAX")

# MAVLink 1: the sender numbers its frames, and a byte made of the definition is only checked.
FRAME = {
    "frame_start": {"is": "constant", "bytes": "FE"},
    "frame_length": {"is": "length", "type": "u8", "counts": ["frame_payload"]},
    "frame_sequence": {"is": "counter", "type": "u8"},
    "frame_sender": {"is": "address", "type": "u16"},
    "frame_message": {"is": "id", "type": "u8"},
    "frame_payload": {"is": "body"},
    "frame_extra": {"is": "id", "type": "u8", "sent": False},
    "frame_checksum": {
        "is": "checksum",
        "type": "u16",
        "method": "crc-16/mcrf4xx",
        "covers": [
            "frame_length",
            "frame_sequence",
            "frame_sender",
            "frame_message",
            "frame_payload",
            "frame_extra",
        ],
    },
}


@dataclass(frozen=True)
class Entry:
    """A named value of an enum."""

    name: str
    value: int
    about: str


@dataclass(frozen=True)
class Enum:
    """An enum; of a bitmask, each value is a bit."""

    name: str
    entries: tuple[Entry, ...]
    is_bitmask: bool


@dataclass(frozen=True)
class Field:
    """A field of a message; an array where it has a count."""

    name: str
    type: str
    count: int
    enum: str
    is_bitmask: bool
    unit: str
    multiplier: str
    invalid: str
    about: str

    @property
    def width(self) -> int:
        """The bytes of one element, by which fields are sorted."""
        return TYPES[self.type][1]


@dataclass(frozen=True)
class Message:
    """A message, its fields in the order of the XML, without extensions."""

    id: int
    name: str
    about: str
    fields: tuple[Field, ...]

    @property
    def size(self) -> int:
        """The bytes of the payload."""
        return sum(each.width * max(each.count, 1) for each in self.fields)

    @property
    def is_carried(self) -> bool:
        """Whether a frame of MAVLink 1 has room for its id and for its payload."""
        return self.id <= 0xFF and self.size <= 0xFF

    @property
    def on_the_wire(self) -> list[Field]:
        """The fields in the order of the frame: the widest first."""
        return sorted(self.fields, key=lambda each: -each.width)


@dataclass
class Definitions:
    """The messages and enums of one edition, those that it includes among them."""

    messages: dict[str, Message] = field(default_factory=dict)
    enums: dict[str, Enum] = field(default_factory=dict)


def definitions(name: str, read: Callable[[str], str]) -> Definitions:
    """Return what an XML file and those that it includes define; `read` returns a file's text."""
    found = Definitions()
    _read(name, read, found, set())
    return found


def _read(name: str, read: Callable[[str], str], found: Definitions, seen: set[str]) -> None:
    if name in seen:
        return
    seen.add(name)
    root = ET.fromstring(read(name))  # noqa: S314  definitions that one has chosen
    for include in root.iter("include"):
        _read((include.text or "").strip(), read, found, seen)
    for enum in root.iter("enum"):
        entries = [*_entries(enum)]
        before = found.enums.get(enum.attrib["name"])
        # Several files may each add values to one enum.
        both = {each.name: each for each in (*(before.entries if before else ()), *entries)}
        is_bitmask = enum.get("bitmask") == "true" or (before is not None and before.is_bitmask)
        name = enum.attrib["name"]
        found.enums[name] = Enum(name, tuple(both.values()), is_bitmask)
    for message in root.iter("message"):
        made = Message(
            int(message.attrib["id"]),
            message.attrib["name"],
            _prose(message.findtext("description")),
            tuple(_fields(message)),
        )
        found.messages[made.name] = made


def _entries(enum: ET.Element) -> Iterator[Entry]:
    following = 0
    for entry in enum.iter("entry"):
        said = entry.get("value")
        value = following if said is None else _number(said)
        following = value + 1
        yield Entry(entry.attrib["name"], value, _prose(entry.findtext("description")))


def _number(said: str) -> int:
    base, _, power = said.partition("**")
    return int(base, 0) ** int(power) if power else int(said, 0)


def _fields(message: ET.Element) -> Iterator[Field]:
    for each in message:
        if each.tag == "extensions":
            return
        if each.tag == "field":
            match = re.fullmatch(r"(\w+?)(_mavlink_version)?(?:\[(\d+)\])?", each.attrib["type"])
            assert match is not None
            yield Field(
                each.attrib["name"],
                match[1],
                int(match[3] or 0),
                each.get("enum", ""),
                each.get("display") == "bitmask",
                each.get("units", "").strip("[]"),
                each.get("multiplier", ""),
                each.get("invalid", ""),
                _prose("".join(each.itertext())),
            )


def _prose(text: str | None) -> str:
    return " ".join((text or "").split()) or "-"


def crc_extra(message: Message) -> int:
    """Return the byte that is made of a definition, as MAVLink's guide to serialization has it."""
    said = f"{message.name} "
    crc = 0xFFFF
    for each in message.on_the_wire:
        said += f"{each.type} {each.name} "
        if each.count:
            said += chr(each.count)
    for byte in said.encode("latin-1"):
        mixed = byte ^ crc & 0xFF
        mixed = (mixed ^ mixed << 4) & 0xFF
        crc = crc >> 8 ^ mixed << 8 ^ mixed << 3 ^ mixed >> 4
    return crc & 0xFF ^ crc >> 8


def in_camel_case(name: str) -> str:
    """Return the name of a message as specs write it: `GPS_RAW_INT` is `GpsRawInt`."""
    return "".join(part.capitalize() for part in name.split("_"))


def in_snake_case(name: str) -> str:
    """Return the name of a field as specs write it: without the blanks that some had."""
    return re.sub(r"\W+", "_", name.strip()).lower()


def spec_of(found: Definitions, names: set[str] | None = None) -> dict[str, Any]:
    """Return the spec of MAVLink 1 with these messages, or with all that it can carry."""
    return {
        "framegen": 2,
        "protocol": {
            "name": "mavlink",
            "title": "MAVLink 1",
            "version": "1.0.0",
            "authority": "definitions",
            "summary": "Messages between vehicles and those who watch and steer them.",
        },
        "sources": {"definitions": {"title": "MAVLink's definitions", "kind": "document"}},
        "endpoints": {"ground": "Whoever watches and steers.", "vehicle": "The vehicle."},
        "link": {"baud": 57600},
        "byte_order": "little",
        "frame": FRAME,
        "messages": {
            in_camel_case(message.name): _message(message, found.enums)
            for message in found.messages.values()
            if message.is_carried and (names is None or message.name in names)
        },
        "history": [{"version": "1.0.0", "changes": ["The messages."]}],
    }


def _message(message: Message, enums: dict[str, Enum]) -> dict[str, Any]:
    return {
        "vendor_name": message.name,
        "id": {"frame_message": message.id, "frame_extra": crc_extra(message)},
        # Either end may send any of them. So each may come unasked, which is the harder case.
        "direction": "vehicle -> ground",
        "summary": message.about,
        "cite": f"definitions, {message.name}",
        "length": message.size,
        "fields": {in_snake_case(each.name): _field(each, enums) for each in message.on_the_wire},
    }


def _field(each: Field, enums: dict[str, Enum]) -> dict[str, Any]:
    found: dict[str, Any] = {"type": TYPES[each.type][0], "about": each.about}
    whole = found["type"][0] != "f"
    if each.count:
        found["count"] = each.count
        if each.type == "char":
            return found | {"text": "ascii"}
    if whole and each.multiplier and "/" not in each.multiplier:
        found["scale"] = f"{float(each.multiplier):f}".rstrip("0") + f" {each.unit}".rstrip()
    elif each.unit:
        found["unit"] = each.unit
    if whole:
        found |= _names(each, enums.get(each.enum))
    return found


def _names(each: Field, enum: Enum | None) -> dict[str, Any]:
    """Return the named values, or the bits, of a number: those that it can have."""
    kind, bits = TYPES[each.type][0][0], each.width * 8
    low, high = (0, (1 << bits) - 1) if kind == "u" else (-1 << bits - 1, (1 << bits - 1) - 1)
    entries = [] if enum is None else [one for one in enum.entries if low <= one.value <= high]
    if enum is not None and (enum.is_bitmask or each.is_bitmask) and kind == "u":
        ones = {one.value.bit_length() - 1: one for one in entries if one.value.bit_count() == 1}
        named = {_named(one, enum): {"at": at, "about": one.about} for at, one in ones.items()}
        return {"bits": named} if named else {}
    values: dict[str, Any] = {}
    taken = set[int]()
    for one in entries:
        if enum is not None and one.value not in taken:
            values[_named(one, enum)] = {"value": one.value, "about": one.about}
            taken.add(one.value)
    absent = _absent(each.invalid)
    if absent is not None and low <= absent <= high and absent not in taken:
        values["not_given"] = {"value": absent, "about": "It is not given."}
    return {"values": values} if values else {}


def _named(entry: Entry, enum: Enum) -> str:
    """Return the name of a value as specs write it: without that of its enum."""
    short = entry.name.removeprefix(f"{enum.name}_")
    return in_snake_case(short if short[0].isalpha() else entry.name)


def _absent(invalid: str) -> int | None:
    """Return the number that says that there is none; of an array, that of its first element."""
    said = invalid.strip("[]").partition(",")[0].partition(":")[0]
    limit = _LIMIT.fullmatch(said)
    if limit is not None:
        return (1 << int(limit[2]) - (not limit[1])) - 1
    try:
        return int(said, 0)
    except ValueError:
        return None
