"""What people write who do not know the language yet, and what they mean by it.

Documents and other tools have other words for the same things. Where one of them stands in a spec,
the hint is the line that this language has for it; what the language leaves out is refused by name.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.language.spec import (
    AddressPart,
    ChecksumPart,
    ConstantPart,
    Example,
    IdPart,
    LengthPart,
    Link,
    ListField,
    Message,
    NumberField,
    ReservedPart,
    Spec,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pydantic import BaseModel

_STUFFING = (
    "byte stuffing cannot be described: undo it in the transport, below the frames, and describe "
    "what is left"
)
_SIGNATURE = (
    "signatures and encryption cannot be described: take such bytes as a field, such as "
    "`{type: u8, count: 8, about: The signature.}`, and check them in your program"
)
_CONDITION = (
    "there are no conditions: describe each form as a message of its own, told apart by an id or "
    "by `always`; or mark the last fields `optional: true`"
)
_NESTED = (
    "an element has a fixed size, and no list in it: describe the whole list as bytes, "
    "`{type: u8, sized_by: ...}`, and take them apart in your program"
)

# What `is:` may be in other words, and what to write.
_KINDS = {
    "header preamble sync magic start prefix signature_bytes stx sof": "is: constant",
    "footer trailer end terminator suffix etx eof delimiter postamble": (
        "is: constant, behind the body"
    ),
    "size len byte_count bytecount datalength": "is: length",
    "command opcode type code function message msg cmd identifier kind": "is: id",
    "payload data parameters params content fields": "is: body",
    "device station unit slave node target destination": "is: address",
    "sequence seq number rolling index packet_number": "is: counter",
    "crc crc8 crc16 crc32 check fcs lrc bcc xor sum chk": "is: checksum, with its `method`",
    "padding pad unused ignored dummy filler spare": "is: reserved",
}

# Keys of any mapping.
_ANYWHERE = {
    "stuffing byte_stuffing stuff escape escaping slip cobs hdlc escape_byte": _STUFFING,
    "signature hmac mac encryption encrypted cipher": _SIGNATURE,
    "if when condition only_if present_if depends_on switch cases case expression unless": (
        _CONDITION
    ),
    "endian endianness byteorder endianess order": "write `byte_order: little`, or `big`",
    "big_endian": "write `byte_order: big`",
    "little_endian": "write `byte_order: little`",
}

_PARAMETERS = "poly polynomial init initial seed start_value xorout xor_out final refin refout"
_COVERAGE = "over of from to range include includes coverage parts fields start end counts bytes"

_BY_MODEL: dict[type[BaseModel], dict[str, str]] = {
    Spec: {
        "header checksum crc envelope framing packet": "these are parts of the `frame`, in order",
        "commands packets requests": "write `messages`",
        "baud baudrate port serial uart": "write `link: {baud: 9600}`",
        "enums types structs constants": "named values stand where they are used, as the `values` "
        "of a field; a type is one of the language's",
        "name title version": "these stand in `protocol`",
        "devices roles ends": "write `endpoints: {host: Asks., device: Answers.}`",
    },
    Link: {
        "baudrate baud_rate speed rate bitrate bps": "write `baud`",
        "bits databits": "write `data_bits`",
        "stop stopbits": "write `stop_bits`",
        "half_duplex duplex echo rs485 one_wire single_wire": "write `local_echo: true` where each "
        "end hears what it sends itself; else leave it out",
    },
    Message: {
        "code opcode command cmd function msg_id number type": "write `id`",
        "response answer returns ack replies": "write `reply`, the message that comes back",
        "nak nack error errors exception failed": "write `refusal`, the message that comes instead "
        "of the reply; or `failure`, the field of the reply that says so",
        "parameters params payload data body arguments args": "write `fields`",
        "size len bytes": "write `length`",
        "sender receiver from to source": "write `direction: host -> device`",
        "about doc comment title": "write `summary`, in one line, or `description`",
        "example": "write `examples`, a list",
        "address broadcast station": "the address is a part of the frame, `is: address`, and the "
        "first argument of every message",
        "note remarks": "write `notes`, a list of `{text: ..., cite: ...}`",
    },
    ListField: {
        "type": "a list of bare numbers has a `type` and no `element`; in one of elements, the "
        "`fields` have types",
        "length size len array repeat times": "write `count: 4`, or `counted_by` or `sized_by` "
        "with what says how many there are",
        "name class": "write `element`, the name of one element's class",
        "optional": "a list may be empty: write `count: 0..`",
    },
    NumberField: {
        "element fields items elements members struct": _NESTED,
        "length size len array repeat times dimension": "write `count: 16` for a list of a fixed "
        "size, or `counted_by` or `sized_by` with what says how long it is",
        "const constant value fixed equals default magic": "write `always: 0` for a value that is "
        "checked, or `reserved: 0` for one that is ignored",
        "padding pad ignore ignored unused skip spare": "write `reserved: 0`",
        "enum names choices options symbols mapping": "write `values: {off: {value: 0, about: "
        "...}}`",
        "flags bitfield bitmask mask bit": "write `bits: {hot: 0, code: 1..3}`",
        "min max minimum maximum": "write `range: 0..100`",
        "factor resolution multiplier offset lsb gain": "write `scale: 0.1 °C`, or with what a "
        "value of 0 is, `scale: 0.1 °C - 40`",
        "signed": "write a signed type, such as `type: i16`",
        "encoding charset string ascii": "write `text: ascii`, at a list of u8",
        "nullable required maybe may_be_absent": "write `optional: true`, at the last fields",
        "description doc comment title name summary": "write `about`",
        "units": "write `unit`",
        "source": "write `cite`",
    },
    Example: {
        "bytes frame data raw packet": "write `hex`",
        "fields decoded parameters": "write `values`",
        "source from": "write `cite`",
        "about name description": "write `title`",
    },
    AddressPart: {
        "broadcast": "write `values: {all: {value: 254, silent: true}}`",
        "min max minimum maximum": "write `range: 1..247`",
        "silent": "silent is a named address: `values: {all: {value: 254, silent: true}}`",
    },
    ChecksumPart: {
        "algorithm crc kind function name model": "write `method`, the name that the catalogue "
        "has for it, such as `crc-16/modbus` or `inverted sum`",
        _PARAMETERS: "write `method`: the name of the CRC says all of these",
        _COVERAGE: "write `covers`",
    },
    LengthPart: {
        "covers includes of over parts fields": "write `counts`",
        "offset add adjust plus minus bias": "list the parts that it counts: `counts` with those "
        "around the body says the same",
    },
    IdPart: {
        "value values range bytes": "the id of a message stands there, as its `id`",
    },
    ConstantPart: {
        "value values hex always const data type": "write `bytes`, in hex: `bytes: AA 55`",
    },
    ReservedPart: {
        "value values hex reserved type size length": "write `bytes`, those that are written: "
        '`bytes: "00"`',
    },
}


def other_kind(tag: str) -> str:
    """Return what to write for an `is:` that the language does not have; nothing if unknown."""
    word = _plain(tag)
    if word in _words("stuffing escape slip cobs byte_stuffing"):
        return _STUFFING
    if word in _words("signature hmac mac"):
        return _SIGNATURE
    if word in _words("timestamp time status error flags version"):
        return "a number with a meaning is a field of the messages, not a part of the frame"
    meant = _found(_KINDS, word)
    return f"write `{meant}`" if meant and "," not in meant else _spelt(meant)


def _spelt(meant: str) -> str:
    kind, _, rest = meant.partition(", ")
    return f"write `{kind}`, {rest}" if kind else ""


def other_key(model: type[BaseModel], key: str) -> str:
    """Return what to write for a key that a mapping does not have; nothing if unknown."""
    word = _plain(key)
    return _found(_BY_MODEL.get(model, {}), word) or _found(_ANYWHERE, word)


def kind_of(mapping: Mapping[str, object]) -> str:
    """Return what `is:` seems to be missing in a part; nothing where its keys do not tell."""
    for kind, keys in _TELLING.items():
        if keys & mapping.keys():
            return kind
    return ""


_TELLING = {
    "checksum": {"method", "covers"},
    "length": {"counts"},
    "constant": {"bytes"},
    "address": {"range", "values"},
    "id": {"sent", "type"},
}

# Types by other names. What the language has no type for is said.
_TYPES = {
    "byte uint8 uint8t uchar char unsignedchar octet bool boolean": "u8",
    "uint16 uint16t ushort word unsignedshort": "u16",
    "uint24 uint24t": "u24",
    "uint32 uint32t uint dword ulong unsignedint": "u32",
    "uint64 uint64t qword": "u64",
    "int8 int8t s8 sbyte signedchar": "i8",
    "int16 int16t s16 short": "i16",
    "int24 s24": "i24",
    "int32 int32t s32 int long": "i32",
    "int64 int64t s64": "i64",
    "float float32 single real": "f32",
    "double float64": "f64",
}
_TEXTS = "string str ascii text chars"


def other_type(name: str) -> str:
    """Return what to write for a type by another name; nothing if unknown."""
    word = _plain(name)
    for ending, order in (("le", "little"), ("be", "big")):
        if word.endswith(ending) and (type_ := _type(word.removesuffix(ending))):
            return f"write `type: {type_}, byte_order: {order}`"
    if type_ := _type(word):
        return f"write `type: {type_}`"
    if word in _words(_TEXTS):
        return "write `type: u8, count: 16, text: ascii`, or with `sized_by` instead of `count`"
    if word == "bcd":
        return "write `type: u4, count: 2, range: 0..9, byte_order: big` for two digits in a byte"
    return ""


def _type(word: str) -> str:
    plain = {"u8", "u16", "u24", "u32", "u64", "i8", "i16", "i24", "i32", "i64", "f32", "f64"}
    return word if word in plain else _found(_TYPES, word)


def _found(table: Mapping[str, str], word: str) -> str:
    return next((meant for words, meant in table.items() if word in _words(words)), "")


def _words(words: str) -> set[str]:
    return {_plain(word) for word in words.split()}


def _plain(word: str) -> str:
    return "".join(letter for letter in word.lower() if letter.isalnum())
