"""Frames with their values: the examples of a spec, and the ends of its ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framegen.model.codec import encode
from framegen.model.slots import Items

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Number

# So many items need two bytes of a count, and of a length: more would show nothing else.
_ENOUGH = 0x100

_End: TypeAlias = Literal["low", "high"]


@dataclass(frozen=True)
class ValidFrame:
    """A frame, and the values that it carries."""

    title: str
    message: MessageLayout
    values: Mapping[str, Any]

    @property
    def data(self) -> bytes:
        """The bytes of the frame."""
        return encode(self.message, self.values)


def valid_frames(model: Model) -> Iterator[ValidFrame]:
    """Yield the frames of every message."""
    for message in model.messages.values():
        yield from frames_of(message)


def frames_of(message: MessageLayout) -> Iterator[ValidFrame]:
    """Yield the examples of one message, then the ends of its ranges."""
    for example in message.message.examples:
        yield ValidFrame(example.title, message, dict(example.values))
    for title, values in range_ends(message):
        yield ValidFrame(title, message, values)


def range_ends(message: MessageLayout) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield every field at its lowest, then at its highest; a list short, then long."""
    if not message.arguments:
        return
    fewest, most = message.counts[0], message.counts[-1]
    many = max(fewest, min(most, _ENOUGH))
    ends: list[tuple[_End, str, int]] = [("low", "lowest", fewest), ("high", "highest", many)]
    for end, word, count in ends:
        shortened = "" if count in (fewest, most) else f", {count} items of up to {most}"
        yield f"every value at its {word}{shortened}", values_at(message, end, count)


def values_at(message: MessageLayout, end: _End, count: int) -> dict[str, Any]:
    """Return every field at one end of its range, and a list of `count` elements."""
    return {
        slot.name: [_item(slot, end) for _ in range(count)]
        if isinstance(slot, Items)
        else _end(slot, end)
        for slot in message.arguments
    }


def _item(items: Items, end: _End) -> Any:
    if items.element is None:
        return _end(items.fields[0], end)
    return {field.name: _end(field, end) for field in items.fields}


def _end(number: Number, end: _End) -> int:
    return number.low if end == "low" else number.high
