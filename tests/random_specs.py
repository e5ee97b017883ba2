"""Specs for Hypothesis with every key of the language, the values of their messages, and lines.

The simplest spec that there is to draw is a constant, an id, a length and a body, and one message
without fields. Whatever is drawn besides is as small as can be.
"""

from collections.abc import Hashable, Sequence
from functools import cache, lru_cache
from itertools import accumulate
from typing import Any

from framegen.cases.valid import frames_of, values_at
from framegen.language.spec import Spec
from framegen.model.checksums import CHECKSUMS
from framegen.model.codec import encode
from framegen.model.layout import MessageLayout
from framegen.model.model import derive
from hypothesis import strategies as st

from tests.factories import small_spec
from tests.second_reader import part_size, varies

Data = dict[str, Any]

WAYS = ("host -> device", "device -> host")
WHOLE = ("u8", "u16", "i8", "i16", "u24", "i24", "u32", "i32", "u64", "i64")
# Bytes that recur, so that what is no frame resembles one.
BYTES = (0x55, 0xAA, 0x00, 0x01, 0x02, 0x03)
METHODS = tuple(CHECKSUMS)
# Few of them, so that most frames of a line have one that is cheap to work out.
USUAL = ("sum", "xor", "inverted sum", "fletcher-8", "crc-16/modbus")


# To make a strategy takes longer than to draw from it, so that each is made once.


@lru_cache(maxsize=512, typed=True)
def _of(*choices: Hashable) -> st.SearchStrategy[Any]:
    return st.sampled_from(choices)


@lru_cache(maxsize=512)
def _either(low: int, high: int, *others: int) -> st.SearchStrategy[int]:
    """Return a whole number of a range, or one of a few."""
    return st.integers(low, high) | _of(*others)


orders = _of("little", "big")
_FEW_BYTES = st.lists(_of(*BYTES), min_size=1, max_size=2)
_METHODS = _of(*USUAL) | _of(*METHODS)
_KINDS = _of(*WHOLE[:4]) | _of(*WHOLE)

_NOTE = {"text": "It was seen.", "cite": "manual, 2"}


def _hex(data: Sequence[int]) -> str:
    return bytes(data).hex(" ").upper()


def _sometimes(draw: st.DrawFn, one_in: int = 4) -> bool:
    return draw(st.integers(0, one_in - 1)) == one_in - 1


# ------------------------------------------------------------------ the frame


@cache
@st.composite
def frames(draw: st.DrawFn, header: Sequence[int] | None = None) -> Data:
    """Draw the parts of a frame, in an order that the language allows."""
    head, tail = draw(_ends())
    checksums = draw(_of(0, 1, 1, 1, 2))
    if header is None:
        # Without a constant in front, a checksum tells what a frame is.
        headers = [(0x55,), (0x55, 0x55), (0x55, 0xAA), *([()] if checksums else [])]
        header = draw(_of(*headers))
    if header:
        head.insert(0, ("header", {"is": "constant", "bytes": _hex(header)}))
    parts: Data = dict([*head, ("body", {"is": "body"}), *tail])
    for number in range(checksums):
        parts = _checksummed(draw, parts, f"check{number}")
    if any(part["is"] == "checksum" for part in parts.values()) and _sometimes(draw):
        parts = _with_unsent(draw, parts)
    if "length" in parts:
        sent = [name for name, part in parts.items() if part.get("sent", True)]
        counted = draw(st.sets(_of(*sent))) | {"body"}
        parts["length"]["counts"] = [name for name in parts if name in counted]
    return parts


Parts = list[tuple[str, Data]]


@cache
@st.composite
def _ends(draw: st.DrawFn) -> tuple[Parts, Parts]:
    """Draw the parts in front of the body and behind it, but for header and checksums."""
    head: Parts = []
    tail: Parts = []
    if draw(_of(True, True, True, False)):
        kind = draw(_of("u8", "u8", "u16", "u24"))
        head.append(("length", _ordered(draw, {"is": "length", "type": kind, "counts": []})))
    for number in range(draw(_of(1, 1, 1, 2, 0))):
        kind = draw(_of("u8", "u8", "u16"))
        head.append((f"id{number}", _ordered(draw, {"is": "id", "type": kind})))
    if _sometimes(draw):
        head.append(("address", draw(_addresses())))
    if _sometimes(draw):
        place = tail if draw(_of(False, False, True)) else head
        place.append(("sequence", _ordered(draw, {"is": "counter", "type": "u8"})))
    for name, what in ("spare", "reserved"), ("mark", "constant"):
        if _sometimes(draw):
            data = _hex(draw(_FEW_BYTES))
            place = tail if draw(_of(False, True)) else head
            place.append((name, {"is": what, "bytes": data}))
    return draw(st.permutations(head)), tail


def _ordered(draw: st.DrawFn, what: Data) -> Data:
    """Give a number a byte order of its own, now and then."""
    return {**what, "byte_order": draw(orders)} if _sometimes(draw) else what


@cache
@st.composite
def _addresses(draw: st.DrawFn) -> Data:
    part: Data = {"is": "address", "type": draw(_of("u8", "u8", "u16"))}
    if draw(st.booleans()):
        low = draw(st.integers(0, 3))
        part["range"] = f"{low}..{low + draw(st.integers(0, 100))}"
    if draw(st.booleans()):
        part["values"] = {"all": {"value": draw(_of(254, 0)), "silent": True}}
    return _ordered(draw, part)


def _checksummed(draw: st.DrawFn, parts: Data, name: str) -> Data:
    """Add a checksum behind the body, or in front of it, that covers some of what there is."""
    method = draw(_METHODS)
    width = draw(_of(*(each for each in CHECKSUMS[method].widths if each != 56)))
    covers = draw(st.lists(_of(*parts), min_size=1, unique=True))
    part = _ordered(draw, {"is": "checksum", "type": f"u{width}", "method": method})
    part["covers"] = ["body"] + [each for each in covers if each != "body"]
    if draw(st.booleans()):
        part["covers"] = [each for each in parts if each in part["covers"]]
    names = [*parts]
    body = names.index("body")
    first = 1 if "header" in parts else 0
    at = draw(_either(first, body, len(names), len(names), body + 1))
    # What stands behind a checksum is covered by it, but for another checksum.
    late = {each for each in names[at:] if parts[each]["is"] == "checksum"}
    part["covers"] = [each for each in part["covers"] if each not in late]
    names.insert(at, name)
    return {each: part if each == name else parts[each] for each in names}


def _with_unsent(draw: st.DrawFn, parts: Data) -> Data:
    """Add an id that is not sent, and covered."""
    checks = [name for name, part in parts.items() if part["is"] == "checksum"]
    check = draw(_of(*checks))
    covers = [*parts[check]["covers"]]
    covers.insert(draw(st.integers(0, len(covers))), "extra")
    added = {**parts, check: {**parts[check], "covers": covers}}
    return {**added, "extra": {"is": "id", "type": "u8", "sent": False}}


# ------------------------------------------------------------------ fields


def _bounds(kind: str) -> tuple[int, int]:
    bits = int(kind[1:])
    return (-(1 << bits - 1), (1 << bits - 1) - 1) if kind[0] == "i" else (0, (1 << bits) - 1)


@cache
@st.composite
def numbers(draw: st.DrawFn, *, whole: bool = False) -> Data:
    """Draw a number of any type, with a range now and then."""
    kind = draw(_KINDS)
    if not whole and _sometimes(draw, 6):
        kind = draw(_of("f32", "f64"))
    field: Data = _ordered(draw, {"type": kind, "about": "A number."})
    if kind[0] == "f":
        return field
    bits, signed = int(kind[1:]), kind[0] == "i"
    low, high = _bounds(kind)
    if not whole and _sometimes(draw, 5):
        value = draw(_of(0, 1, high))
        return {**field, draw(_of("always", "reserved")): value}
    if _sometimes(draw):
        bottom = draw(_either(low, high, 0, 1))
        top = draw(st.integers(bottom, high))
        field["range"] = f"{bottom}..{top}"
    elif not signed and _sometimes(draw, 6):
        field["bits"] = {"low": 0, "rest": f"1..{bits - 1}"}
    return field


@cache
@st.composite
def _texts(draw: st.DrawFn) -> Data:
    size = draw(st.integers(1, 4))
    return {"type": "u8", "count": size, "text": "ascii", "about": "Some text."}


@cache
@st.composite
def _packed(draw: st.DrawFn) -> Data:
    bits, count = draw(_of((4, 2), (1, 8), (12, 2), (11, 8), (3, 8)))
    field: Data = {"type": f"u{bits}", "count": count, "about": "Some bits."}
    if _sometimes(draw):
        field["range"] = f"1..{(1 << bits) - 2}" if bits > 1 else "0..0"
    return _ordered(draw, field)


_INNER = st.lists(numbers() | numbers() | _texts(), min_size=1, max_size=3)


@cache
@st.composite
def _elements(draw: st.DrawFn) -> Data:
    inner = draw(_INNER)
    if all("always" in each or "reserved" in each for each in inner):
        inner.append({"type": "u8", "about": "A number."})
    fields = {f"part{number}": each for number, each in enumerate(inner)}
    return {"element": "Item", "about": "Some elements.", "fields": fields}


@cache
@st.composite
def _bare(draw: st.DrawFn) -> Data:
    field = draw(numbers(whole=True))
    field.pop("bits", None)
    if field["type"] == "u8" and _sometimes(draw, 2):
        return {"type": "u8", "about": "Some text.", "text": "ascii"}
    return field


_LISTED = _bare() | _elements()


@cache
@st.composite
def _single_fields(draw: st.DrawFn) -> Data:
    if not _sometimes(draw):
        return draw(numbers())
    kind = draw(_of("text", "packed", "list", "list"))
    if kind == "text":
        return draw(_texts())
    if kind == "packed":
        return draw(_packed())
    listed = draw(_LISTED)
    return {**listed, "count": draw(st.integers(1, 4 if listed.get("text") else 3))}


_SINGLE = st.lists(_single_fields(), max_size=3)


def _bodies(draw: st.DrawFn, length: Data | None) -> tuple[Data, str, bool]:
    """Draw the fields of a message, and what its length depends on; and whether they may lack."""
    fields = {f"field{number}": each for number, each in enumerate(draw(_SINGLE))}
    shape = draw(_of("plain", "plain", "list", "optional"))
    if shape == "optional" and length is not None:
        for number in range(draw(st.integers(1, 3))):
            field = draw(numbers(whole=True))
            fields[f"more{number}"] = {**field, "optional": True}
        return fields, "", True
    if shape != "list":
        return fields, "", False
    return *_listed(draw, fields, length), False


def _listed(draw: st.DrawFn, fields: Data, length: Data | None) -> tuple[Data, str]:
    """Add a list of a size that varies, with what says how long it is."""
    items = draw(_LISTED)
    hows = ["counted_by", "sized_by", *([] if length is None else ["left", "left", "both"])]
    how = draw(_of(*hows))
    kind = _ordered(draw, {"type": draw(_of("u8", "u8", "u16")), "about": "Of it."})
    before = [*fields.items()]
    if length is not None and how == "left":
        kind = length
    if how in ("counted_by", "sized_by", "both"):
        counter = "number" if how == "counted_by" else "size"
        before.insert(draw(st.integers(0, len(before))), (counter, kind))
        items = {**items, "sized_by" if how == "both" else how: counter}
        if how == "both":
            before.insert(draw(st.integers(0, len(before))), ("number", {**kind, "type": "u8"}))
            items["counted_by"] = "number"
    else:
        items = {**items, "sized_by": "length"}
    # A frame has no more than 64 KiB, whatever its length could say.
    open_ended = kind["type"] == "u8"
    if not open_ended or draw(st.booleans()):
        low = draw(st.integers(0, 2))
        bounds = [f"{low}..{low + 4}", *([f"{low}.."] if open_ended else [])]
        items["count"] = draw(_of(*bounds))
    return {**dict(before), "items": items}, "number" if "counted_by" in items else "items"


# ------------------------------------------------------------------ the whole


@st.composite
def specs(draw: st.DrawFn) -> Data:
    """Draw a spec, as the data of its YAML."""
    first = draw(frames())
    kinds: Data = {"frame": first}
    several = _sometimes(draw)
    if several:
        header = draw(_of(None, (0x55, 0x01)))
        kinds = {"one": first, "two": draw(frames(header))}
    messages: Data = {}
    for number in range(draw(st.integers(1, 5))):
        way = WAYS[number % 2] if number < 2 else draw(_of(*WAYS))
        kind = draw(_of(*kinds))
        message = _messages(draw, kinds[kind], [*messages.values()], kind, way)
        if message is not None:
            _name_elements(message, number)
            messages[f"Message{number}"] = {**message, **({"frame": kind} if several else {})}
    spec = small_spec("made_up", kinds if several else first, messages)
    device = {"about": "Answers.", "notes": [_NOTE]}
    return {**spec, "endpoints": {"host": "Asks.", "device": device}, "byte_order": draw(orders)}


def _messages(
    draw: st.DrawFn, parts: Data, others: Sequence[Data], kind: str, way: str
) -> Data | None:
    ids = {name: part for name, part in parts.items() if part["is"] == "id"}
    sent = [name for name, part in ids.items() if part.get("sent", True)]
    small = _of(1, 2, 3, 0x55, 255)
    given = {name: draw(small) for name in ids}
    same = [each for each in others if (each["direction"], each.get("frame", kind)) == (way, kind)]
    if any(_ids(each, ids, sent) == [given[name] for name in sent] for each in same):
        return None
    fields, variable, optional = _bodies(draw, parts.get("length"))
    message: Data = {"direction": way, "summary": "Say something.", "cite": "manual, 1"}
    message["notes"] = [_NOTE]
    if given:
        message["id"] = given if len(given) > 1 else next(iter(given.values()))
    rule = _rule(parts, fields, variable)
    lengths = _optional_lengths(parts, fields) if optional else None
    if lengths is None:
        message["length"] = rule
    else:
        chosen = draw(st.sets(_of(*lengths)))
        message["length"] = sorted(chosen | {lengths[0], lengths[-1]})
    return {**message, "fields": fields}


def _name_elements(message: Data, number: int) -> None:
    """Give every kind of element a name of its own."""
    for key, field in message["fields"].items():
        if "element" in field:
            field["element"] = f"{key.capitalize()}Of{number}"


def with_examples(spec: Data) -> Data:
    """Return a spec in which every message has frames, as they are made up by the reference."""
    model = derive(Spec.model_validate(spec))
    messages = {
        name: {**message, "examples": _examples(model.messages[name])}
        for name, message in spec["messages"].items()
    }
    return {**spec, "messages": messages}


def _examples(message: MessageLayout) -> list[Data]:
    """Return frames with every end of a range, also those of the elements of lists."""
    counts = message.counts
    some = {counts[0], counts[-1] if message.optional else counts[min(2, len(counts) - 1)]}
    ends = [values_at(message, end, count) for end in ("low", "high") for count in sorted(some)]
    beyond = [frame.values for frame in frames_of(message) if " of " in frame.title]
    shown = {encode(message, values): values for values in map(_readable, [*ends, *beyond])}
    return [
        {"title": f"Example {number}", "hex": _hex(data), "values": values, "constructed": "Dice."}
        for number, (data, values) in enumerate(shown.items(), 1)
    ]


def _readable(value: Any) -> Any:
    """Return values without the characters that no reader of a spec could see."""
    if isinstance(value, str):
        return value.replace("\0", "a").replace("\x7f", "~")
    return {key: _readable(each) for key, each in value.items()} if type(value) is dict else value


def _ids(message: Data, ids: Data, sent: Sequence[str]) -> list[int]:
    if not ids:
        return []
    said = message["id"] if isinstance(message["id"], dict) else {next(iter(ids)): message["id"]}
    return [said[name] for name in sent]


def _counted(parts: Data) -> int:
    """Return the number of bytes besides the body that a length counts."""
    length = parts.get("length")
    names = parts if length is None else length["counts"]
    return sum(part_size(parts[name]) for name in names if parts[name].get("sent", True))


def _width(field: Data) -> int:
    """Return the size of a field in bytes; of a list that varies, of an element."""
    times = 1 if varies(field) else int(field.get("count", 1))
    if "element" in field:
        return times * sum(map(_width, field["fields"].values()))
    return times * int(field["type"][1:]) // 8


def _rule(parts: Data, fields: Data, variable: str) -> str:
    constant = _counted(parts)
    constant += sum(_width(field) for name, field in fields.items() if name != "items")
    return f"{_width(fields['items'])} * {variable} + {constant}" if variable else str(constant)


def _optional_lengths(parts: Data, fields: Data) -> list[int]:
    optional = [field for field in fields.values() if field.get("optional")]
    least = _counted(parts) + sum(map(_width, fields.values())) - sum(map(_width, optional))
    return [*accumulate(map(_width, optional), initial=least)]


# ------------------------------------------------------------------ values


@st.composite
def values_of(draw: st.DrawFn, spec: Data, name: str) -> Data:
    """Draw the values of a message, such as a user gives."""
    message = spec["messages"][name]
    parts = (spec.get("frames") or {"frame": spec.get("frame")})[message.get("frame", "frame")]
    fields = message["fields"]
    values: Data = {}
    for part, what in parts.items():
        if what["is"] == "address":
            values[part] = draw(_address_values(what))
        elif what["is"] == "counter":
            values[part] = draw(st.integers(0, 255))
    counters = {field.get(how) for field in fields.values() for how in ("counted_by", "sized_by")}
    there = _there(draw, parts, message)
    for key, field in fields.items():
        if key in counters or "always" in field or "reserved" in field:
            continue
        is_there = key in there or not field.get("optional")
        values[key] = draw(_values(field)) if is_there else None
    return values


def _there(draw: st.DrawFn, parts: Data, message: Data) -> list[str]:
    """Draw which of the optional fields there are."""
    if not isinstance(message["length"], list):
        return []
    sizes = _optional_lengths(parts, message["fields"])
    number = draw(_of(*map(sizes.index, message["length"])))
    optional = [key for key, field in message["fields"].items() if field.get("optional")]
    return optional[:number]


def _address_values(what: Data) -> st.SearchStrategy[int]:
    low, _, high = what.get("range", f"0..{(1 << int(what['type'][1:])) - 1}").partition("..")
    named = [each["value"] for each in what.get("values", {}).values()]
    return _either(int(low), int(high), *named, int(low))


def _values(field: Data) -> st.SearchStrategy[Any]:
    letters = st.text(st.sampled_from("aZ~\x01\0"), max_size=0x7F)
    if field.get("text") and not varies(field):
        return letters.map(lambda text: text[: field["count"]].rstrip("\0"))
    if "count" not in field and not varies(field):
        return _number_values(field)
    low = high = field.get("count", 0)
    if varies(field):
        bottom, _, top = str(field.get("count", "0..")).partition("..")
        low, high = int(bottom), int(top or int(bottom) + 5)
    if field.get("text"):
        return st.text(st.sampled_from("aZ~\x01\0"), min_size=low, max_size=high)
    if "element" not in field:
        return st.lists(_number_values(field), min_size=low, max_size=high)
    given = {
        key: _values(each)
        for key, each in field["fields"].items()
        if "always" not in each and "reserved" not in each
    }
    return st.lists(st.fixed_dictionaries(given), min_size=low, max_size=high)


def _number_values(field: Data) -> st.SearchStrategy[Any]:
    kind, bits = field["type"][0], int(field["type"][1:])
    if kind == "f":
        return st.floats(width=32 if bits == 32 else 64, allow_nan=False)
    low, high = _bounds(field["type"])
    if "range" in field:
        low, high = (int(each) for each in field["range"].split(".."))
    near = [each for each in (0x55, 0xAA, 1, 0) if low <= each <= high]
    return _either(low, high, *near, low, high)


# ------------------------------------------------------------------ lines

_NOISE = st.lists(_of(*BYTES), max_size=4)


@st.composite
def lines(draw: st.DrawFn, frames_: Sequence[bytes]) -> bytes:
    """Draw a line with some of these frames: whole, cut, damaged, and among noise."""
    pieces = []
    for _ in range(draw(st.integers(0, 4))):
        frame = draw(st.sampled_from(frames_))
        what = draw(_of("whole", "whole", "cut", "damaged", "doubled", "noise"))
        at = draw(st.integers(0, len(frame)))
        if what == "cut":
            frame = frame[:at]
        elif what == "damaged":
            other = bytes([draw(_either(0, 255, *BYTES))])
            frame = frame[:at] + other + frame[at + draw(st.integers(0, 1)) :]
        elif what == "doubled":
            frame = frame[:at] + draw(st.sampled_from(frames_)) + frame[at:]
        elif what == "noise":
            frame = bytes(draw(_NOISE))
        pieces.append(frame)
    return b"".join(pieces)
