"""A second reading of the spec language, by brute force, from the text of a spec alone.

The reference codec derives what stands where, solves length rules and refuses early. This does
none of that: it tries every message with every number of elements, cuts a frame into pieces, and
looks whether all of them are right. It shares nothing with the model but the catalogue of
checksums, which is held to others elsewhere.
"""

import struct
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import accumulate
from typing import Any, TypeAlias

from framegen.model.checksums import CHECKSUMS

Data: TypeAlias = dict[str, Any]
Values: TypeAlias = dict[str, Any]
Event: TypeAlias = tuple[str, bytes]


@dataclass(frozen=True)
class Cell:
    """Some bytes of a frame: which part or field they are, of which element, and in which part."""

    part: str
    field: Data
    size: int
    name: str = ""
    index: int | None = None
    element: str = ""


class Reader:
    """Reads and writes the frames of a spec, given as plain data."""

    def __init__(self, spec: Data) -> None:
        self.spec = spec
        self.frames: dict[str, Data] = spec.get("frames") or {"frame": spec["frame"]}

    # ------------------------------------------------------------------ whole frames

    def read(self, name: str, frame: bytes) -> Values | None:
        """Return the values of a whole frame of this message; None if it is none."""
        found = [
            values
            for cells in self._shapes(name, len(frame))
            if (values := self._values(name, cells, frame)) is not None
        ]
        assert len(found) <= 1, "a frame can be read in one way"
        return found[0] if found else None

    def names(self, directions: Sequence[str]) -> list[str]:
        """Return the messages of some directions: those of a kind of frame together, in order."""
        messages = self.spec["messages"]
        return [
            name
            for kind in self.frames
            for way in directions
            for name, message in messages.items()
            if message["direction"] == way and self._kind(message) == kind
        ]

    def _kind(self, message: Data) -> str:
        return str(message.get("frame", next(iter(self.frames))))

    def _shapes(self, name: str, size: int) -> Iterator[list[Cell]]:
        """Yield the cells of frames of `size` bytes: for each number of elements, or of fields."""
        message = self.spec["messages"][name]
        varying = [field for field in message.get("fields", {}).values() if varies(field)]
        for number in self._numbers(name, size):
            cells = self._cells(name, number)
            if sum(cell.size for cell in cells) != size:
                continue
            if varying and not self._may_have(varying[0], number):
                continue
            if isinstance(message["length"], list) and not self._listed(message, cells):
                continue
            yield cells

    def _numbers(self, name: str, size: int) -> range:
        """Return how many elements, or optional fields, frames of up to `size` bytes may have."""
        fields: Data = self.spec["messages"][name].get("fields", {})
        if not any(map(varies, fields.values())):
            return range(1 + sum("optional" in field for field in fields.values()))
        least, step = self._least_and_step(name)
        number = (size - least) // step
        return range(max(number, 0), number + 1)

    @cache  # noqa: B019 - a reader lives no longer than its example
    def _least_and_step(self, name: str) -> tuple[int, int]:
        least, more = (sum(cell.size for cell in self._cells(name, n)) for n in (0, 1))
        return least, more - least

    @cache  # noqa: B019
    def _sizes(self, name: str, most: int) -> list[int]:
        """Return the sizes up to `most` that frames of a message may have, or more."""
        fields: Data = self.spec["messages"][name].get("fields", {})
        if any(map(varies, fields.values())):
            least, step = self._least_and_step(name)
            return [*range(least, most + 1, step)]
        numbers = self._numbers(name, most)
        return [sum(cell.size for cell in self._cells(name, number)) for number in numbers]

    @cache  # noqa: B019
    def _cells(self, name: str, number: int) -> list[Cell]:
        """Return the cells of a frame with so many elements, or so many of its optional fields."""
        message = self.spec["messages"][name]
        fields: Data = message.get("fields", {})
        optional = [key for key, field in fields.items() if field.get("optional")]
        varying = any(map(varies, fields.values()))
        absent = set() if varying else set(optional[number:])
        body = [
            cell
            for key, field in fields.items()
            if key not in absent
            for cell in self._field(key, field, number)
        ]
        cells: list[Cell] = []
        for part, what in self.frames[self._kind(message)].items():
            if what["is"] == "body":
                cells += [Cell(part, *rest) for rest in body]
            elif what.get("sent", True):
                cells.append(Cell(part, what, part_size(what)))
        return cells

    def _may_have(self, field: Data, number: int) -> bool:
        low, _, high = str(field.get("count", "0..")).partition("..")
        return int(low) <= number and (not high or number <= int(high))

    def _listed(self, message: Data, cells: Sequence[Cell]) -> bool:
        return self._length(message, cells) in message["length"]

    def _length(self, message: Data, cells: Sequence[Cell]) -> int:
        parts = self.frames[self._kind(message)]
        counted = next((part["counts"] for part in parts.values() if part["is"] == "length"), None)
        return sum(cell.size for cell in cells if counted is None or cell.part in counted)

    def _field(self, key: str, field: Data, number: int) -> Iterator[tuple[Any, ...]]:
        """Yield the cells of a field, without their part."""
        times: int | None = None
        if varies(field):
            times = number
        elif "count" in field:
            times = int(field["count"])
        if "element" in field:
            for index in range(times or 0):
                for inner, each in field["fields"].items():
                    yield each, _size(each) * int(each.get("count", 1)), inner, index, key
            return
        single = {"always", "reserved", "text"} & field.keys() and not varies(field)
        if times is None or single or _bits(field) % 8:
            yield field, _bits(field) * (times or 1) // 8, key
            return
        for index in range(times):
            yield field, _size(field), "", index, key

    def _values(self, name: str, cells: Sequence[Cell], frame: bytes) -> Values | None:
        """Return the values of a frame that is cut into these cells; None if one is wrong."""
        message = self.spec["messages"][name]
        parts = self.frames[self._kind(message)]
        ends = list(accumulate(cell.size for cell in cells))
        data = [frame[end - cell.size : end] for cell, end in zip(cells, ends, strict=True)]
        by_part: dict[str, bytes] = dict.fromkeys(parts, b"")
        for cell, piece in zip(cells, data, strict=True):
            by_part[cell.part] += piece
        for part, what in parts.items():
            if not self._part_holds(message, part, what, by_part):
                return None
        values: Values = {
            key: None if field.get("optional") else []
            for key, field in message.get("fields", {}).items()
        }
        for part, what in parts.items():
            if what["is"] in ("address", "counter"):
                values[part] = int.from_bytes(by_part[part], self._order(what))
        for cell, piece in zip(cells, data, strict=True):
            if parts[cell.part]["is"] == "body" and not self._take(cell, piece, values):
                return None
        return self._derived(message, values)

    def _part_holds(self, message: Data, part: str, what: Data, by_part: dict[str, bytes]) -> bool:
        piece, order = by_part[part], self._order(what)
        match what["is"]:
            case "constant":
                return piece == bytes.fromhex(what["bytes"])
            case "length":
                counted = sum(len(by_part[each]) for each in what["counts"])
                return int.from_bytes(piece, order) == counted
            case "id":
                return not what.get("sent", True) or piece == self._id(message, part)
            case "address":
                return self._is_address(what, int.from_bytes(piece, order))
            case "checksum":
                return piece == self._checksum(what, self._with_ids(message, by_part))
        return True

    def _with_ids(self, message: Data, by_part: dict[str, bytes]) -> dict[str, bytes]:
        parts = self.frames[self._kind(message)]
        hidden = [part for part, what in parts.items() if not what.get("sent", True)]
        return by_part | {part: self._id(message, part) for part in hidden}

    def _checksum(self, what: Data, by_part: dict[str, bytes]) -> bytes:
        size = part_size(what)
        covered = b"".join(by_part[each] for each in what["covers"])
        return CHECKSUMS[what["method"]].of(covered, 8 * size).to_bytes(size, self._order(what))

    def _id(self, message: Data, part: str) -> bytes:
        what = self.frames[self._kind(message)][part]
        number = message["id"][part] if isinstance(message["id"], dict) else message["id"]
        return int(number).to_bytes(part_size(what), self._order(what))

    @staticmethod
    def _is_address(what: Data, number: int) -> bool:
        named = [each["value"] for each in what.get("values", {}).values()]
        low, _, high = str(what.get("range", "0..")).partition("..")
        return number in named or (int(low) <= number <= int(high or number))

    def _order(self, what: Data) -> Any:
        return what.get("byte_order", self.spec["byte_order"])

    # ------------------------------------------------------------------ fields

    def _take(self, cell: Cell, piece: bytes, values: Values) -> bool:
        """Put the value of a cell where it belongs; tell whether it is one."""
        field = cell.field
        if "always" in field:
            return piece == self._number(field, field["always"]) * int(field.get("count", 1))
        if "reserved" in field:
            return True
        value = self._value(field, cell, piece)
        if value is None:
            return False
        if cell.index is None:
            values[cell.name] = value
            return True
        items = values[cell.element]
        if not cell.name:
            items.append(value)
            return True
        if len(items) == cell.index:
            items.append({})
        items[cell.index][cell.name] = value
        return True

    def _value(self, field: Data, cell: Cell, piece: bytes) -> Any:
        if (field.get("text") and cell.index is None) or (cell.name and field.get("text")):
            text = piece.decode("latin-1").rstrip("\0")
            return text if text.isascii() else None
        if field.get("text"):
            return piece[0] if piece[0] < 0x80 else None
        bits = _bits(field)
        if bits % 8:
            numbers = self._unpacked(field, bits, piece)
            return numbers if all(_in_range(field, each) for each in numbers) else None
        order = self._order(field)
        if field["type"][0] == "f":
            letter = {4: "f", 8: "d"}[len(piece)]
            return struct.unpack(("<" if order == "little" else ">") + letter, piece)[0]
        number = int.from_bytes(piece, order, signed=field["type"][0] == "i")
        return number if _in_range(field, number) else None

    def _unpacked(self, field: Data, bits: int, piece: bytes) -> list[int]:
        """Read packed numbers from a string of bits, the lowest first, or the highest."""
        if self._order(field) == "little":
            line = "".join(f"{byte:08b}"[::-1] for byte in piece)
            return [int(line[at : at + bits][::-1], 2) for at in range(0, len(line), bits)]
        line = "".join(f"{byte:08b}" for byte in piece)
        return [int(line[at : at + bits], 2) for at in range(0, len(line), bits)]

    def _number(self, field: Data, value: float) -> bytes:
        order = self._order(field)
        if field["type"][0] == "f":
            letter = {32: "f", 64: "d"}[_bits(field)]
            return struct.pack(("<" if order == "little" else ">") + letter, value)
        return int(value).to_bytes(_size(field), order, signed=field["type"][0] == "i")

    def _derived(self, message: Data, values: Values) -> Values | None:
        """Leave out what is no value of its own; None where counts or sizes are wrong."""
        fields: Data = message.get("fields", {})
        for key, field in fields.items():
            if "always" in field or "reserved" in field:
                del values[key]
        for key, field in fields.items():
            if not varies(field):
                continue
            number = len(values[key])
            if isinstance(field.get("text"), str):
                values[key] = bytes(values[key]).decode("ascii")
            size = _element_size(field)
            due = {"counted_by": number, "sized_by": number * size}
            for how, right in due.items():
                counter = field.get(how)
                if counter in fields and values.pop(counter, right) != right:
                    return None
        return values

    # ------------------------------------------------------------------ streams

    def scan(self, directions: Sequence[str], data: bytes) -> list[Event]:
        """Read a line that has gone quiet: messages, unknown frames that are proven, and noise.

        At each byte, the longest frame that is legal there: of a message, the first of equals in
        the order of the spec, or of an unknown id with the right checksum; else it is noise.
        """
        events: list[Event] = []
        at = 0
        while at < len(data):
            kind, size = self.begins(directions, data[at:]) or ("noise", 1)
            piece = data[at : at + size]
            if kind == "noise" and events and events[-1][0] == "noise":
                events[-1] = ("noise", events[-1][1] + piece)
            else:
                events.append((kind, piece))
            at += size
        return events

    def begins(self, directions: Sequence[str], data: bytes) -> tuple[str, int] | None:
        """Return the message that `data` begins with, or `unknown`, and the size of its frame."""
        found = [
            (name, size)
            for name in self.names(directions)
            for size in self._sizes(name, len(data))
            if size <= len(data) and self.read(name, data[:size]) is not None
        ]
        most = min(len(data), self.largest(directions))
        for kind in self.frames:
            known = self._known(kind, tuple(directions))
            least = sum(map(part_size, self.frames[kind].values()))
            sizes = range(least, most + 1) if known else ()
            found += [
                ("unknown", size) for size in sizes if self._is_unknown(kind, known, data[:size])
            ]
        return max(found, key=lambda each: each[1], default=None)

    def largest(self, directions: Sequence[str]) -> int:
        return max((self._largest(name) for name in self.names(directions)), default=0)

    def _largest(self, name: str) -> int:
        message = self.spec["messages"][name]
        parts, fields = self.frames[self._kind(message)], message.get("fields", {})
        fixed: int = sum(part_size(part) for part in parts.values() if part.get("sent", True))
        none, one = (
            sum(cell[1] for key, each in fields.items() for cell in self._field(key, each, number))
            for number in (0, 1)
        )
        length = next((part for part in parts.values() if part["is"] == "length"), None)
        counted = 0 if length is None else sum(part_size(parts[each]) for each in length["counts"])
        field = next(filter(varies, fields.values()), None)
        if field is None:
            listed = isinstance(message["length"], list)
            return fixed + (max(message["length"]) - counted if listed else int(none))
        step = one - none
        most = 0xFFFF
        if length is not None:
            most = (1 << 8 * part_size(length)) - 1 + fixed - counted
        number: int = (most - fixed - none) // step
        high = str(field.get("count", "0..")).partition("..")[2]
        number = min(number, int(high)) if high else number
        for how, unit in (("counted_by", 1), ("sized_by", step)):
            counter = fields.get(field.get(how))
            if counter is not None:
                number = min(number, ((1 << _bits(counter)) - 1) // unit)
        return int(fixed + none + number * step)

    @cache  # noqa: B019
    def _known(self, kind: str, directions: tuple[str, ...]) -> list[dict[str, bytes]]:
        """Return the ids of the messages that have such a frame; none where none is proven."""
        parts: Data = self.frames[kind]
        roles = [what["is"] for what in parts.values()]
        proven = "checksum" in roles and "length" in roles and "id" in roles
        if not proven or not all(what.get("sent", True) for what in parts.values()):
            return []
        ids = [part for part, what in parts.items() if what["is"] == "id"]
        return [
            {part: self._id(message, part) for part in ids}
            for message in self.spec["messages"].values()
            if message["direction"] in directions and self._kind(message) == kind
        ]

    def _is_unknown(self, kind: str, known: list[dict[str, bytes]], frame: bytes) -> bool:
        parts: Data = self.frames[kind]
        body = len(frame) - sum(map(part_size, parts.values()))
        by_part, at = {}, 0
        for part, what in parts.items():
            size = body if what["is"] == "body" else part_size(what)
            by_part[part] = frame[at : at + size]
            at += size
        others = {part: what for part, what in parts.items() if what["is"] != "id"}
        plain = {part: what for part, what in others.items() if what["is"] != "checksum"}
        return (
            all(self._part_holds({}, part, what, by_part) for part, what in plain.items())
            and all(any(by_part[part] != id_ for part, id_ in ids.items()) for ids in known)
            and all(
                by_part[part] == self._checksum(what, by_part)
                for part, what in others.items()
                if part not in plain
            )
        )


def varies(field: Data) -> bool:
    return "counted_by" in field or "sized_by" in field


def _element_size(field: Data) -> int:
    if "element" not in field:
        return _size(field)
    return sum(_size(each) * int(each.get("count", 1)) for each in field["fields"].values())


def _bits(field: Data) -> int:
    return int(field["type"][1:])


def _size(field: Data) -> int:
    return _bits(field) // 8


def part_size(part: Data) -> int:
    if part["is"] == "body":
        return 0
    return len(bytes.fromhex(part["bytes"])) if "bytes" in part else _bits(part) // 8


def _in_range(field: Mapping[str, Any], number: int) -> bool:
    if "range" not in field:
        return True
    low, _, high = str(field["range"]).partition("..")
    return int(low) <= number and (not high or number <= int(high))
