"""The messages of `pyubx2`, from the package index, held to the layouts of the same frames."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from framegen.model.codec import encode
from framegen.model.slots import Constant, Items, Text

from tests.protocols.peer import Peer, Values, as_is, with_values
from tests.protocols.specs import messages_of


class Pyubx2(Peer):
    """The messages of `pyubx2`, whose values stand in the order of the frame."""

    protocol = "ubx"
    package = "pyubx2"
    writes = dict.fromkeys(messages_of("ubx"), as_is)
    reads = dict.fromkeys(messages_of("ubx"), as_is) | {
        # It knows no shorter one.
        "NavPvt": with_values(
            **dict.fromkeys(
                ("vehicle_heading", "declination", "declination_accuracy"),
                lambda value: value or 0,
            )
        )
    }

    def _mode(self, message: str) -> int:
        if message.endswith("Poll"):
            return int(self.module.POLL)
        return int(self.module.SET if message.endswith("Set") else self.module.GET)

    def write(self, message: str, values: Values) -> bytes:
        layout = messages_of(self.protocol)[message]
        frame = encode(layout, values)
        # Its frame of our payload: class, length and checksum are its own.
        made = self.module.UBXMessage(
            frame[2:3], frame[3:4], self._mode(message), payload=frame[6:-2]
        )
        assert made.identity.upper() == layout.message.vendor_name.removeprefix("UBX-")
        return bytes(made.serialize())

    def read(self, message: str, frame: bytes) -> Values:
        layout = messages_of(self.protocol)[message]
        read = self.module.UBXReader.parse(frame, msgmode=self._mode(message), parsebitfield=0)
        theirs = {part.at: part for part in self._parts(read)}
        count = layout.count_of(frame)
        found = {
            placed.path: theirs[placed.at - 6].value
            if placed.at - 6 in theirs and theirs[placed.at - 6].size == placed.size
            # It takes several numbers of ours for one.
            else _part_of(theirs.values(), placed.at - 6, placed.size)
            for placed in layout.lay_out(count)
            if not isinstance(placed.slot, Constant) and 6 <= placed.at < len(frame) - 2
        }
        return {slot.name: _gathered(slot, found) for slot in layout.arguments}

    def _parts(self, read: Any) -> "Iterator[_Part]":
        at = 0
        if not read.payload:
            return
        for name, kind, suffix in _flat(read, read._get_dict(payload=read.payload), ""):
            size, scale = _size_and_scale(kind)
            value = getattr(read, f"{name.removesuffix('_bit')}{suffix}")
            if kind == "CH":
                value = value.encode("ascii")
                size = len(value)
            yield _Part(at, size, _plain(value, scale))
            at += size


@dataclass(frozen=True)
class _Part:
    """A value of theirs, where it stands in the payload, and its size."""

    at: int
    size: int
    value: Any


def _flat(read: Any, theirs: Mapping[str, Any], suffix: str) -> Iterator[tuple[str, Any, str]]:
    """Yield the names and types of what a message holds, group by group."""
    for name, kind in theirs.items():
        if not name.endswith("_grp"):
            yield name, kind, suffix
            continue
        group = kind[1]
        first = next(iter(group)).removesuffix("_bit")
        index = 1
        while hasattr(read, f"{first}_{index:02d}"):
            yield from _flat(read, group, f"_{index:02d}")
            index += 1


def _size_and_scale(kind: Any) -> tuple[int, float]:
    scale = 1.0
    if isinstance(kind, tuple):
        kind, scale = kind[0], kind[1] if isinstance(kind[1], float) else 1.0
    return (0 if kind == "CH" else int(kind[1:])), scale


def _plain(value: Any, scale: float) -> Any:
    """Return a value without its scale; of bits, the number."""
    if scale != 1:
        return round(value / scale)
    return value


def _part_of(parts: Iterable[_Part], at: int, size: int) -> Any:
    """Return some bytes of a number of theirs as one."""
    for part in parts:
        if part.at <= at and at + size <= part.at + part.size:
            whole = (
                part.value
                if isinstance(part.value, bytes)
                else part.value.to_bytes(part.size, "little")
            )
            return int.from_bytes(whole[at - part.at : at - part.at + size], "little")
    raise AssertionError(f"nothing stands at {at}")


def _gathered(slot: Any, found: Mapping[str, Any]) -> Any:
    """Return the value of an argument from values by path."""
    if not isinstance(slot, Items):
        return _ours_of(slot, found[slot.name])
    count = len({path.partition("]")[0] for path in found if path.startswith(f"{slot.name}[")})
    if slot.text is not None:
        return "".join(chr(each) for each in _numbers(slot, found, count))
    if slot.element is None:
        return _numbers(slot, found, count)
    return [
        {field.name: _ours_of(field, found[slot.path(index, field)]) for field in slot.fields}
        for index in range(count)
    ]


def _numbers(slot: Items, found: Mapping[str, Any], count: int) -> list[Any]:
    return [_ours_of(slot, found[f"{slot.name}[{index}]"]) for index in range(count)]


def _ours_of(slot: Any, value: Any) -> Any:
    if isinstance(slot, Text):
        return bytes(value).rstrip(b"\0").decode("ascii")
    return int.from_bytes(value, "little") if isinstance(value, bytes) else value
