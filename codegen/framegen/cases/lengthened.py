"""Frames that begin as whole frames of shorter messages do, checksum and all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.model.apart import begun
from framegen.model.codec import encode, values_of
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True)
class Lengthened:
    """A frame of a message whose first bytes are one of a shorter message."""

    short: MessageLayout
    long: MessageLayout
    data: bytes

    @property
    def beginning(self) -> bytes:
        """The frame of the shorter message."""
        return self.data[: self.short.least]

    @property
    def values(self) -> dict[str, Any]:
        """The values that the frame carries."""
        return values_of(self.long, self.data)


def lengthened(model: Model) -> Iterator[Lengthened]:
    """Yield a frame for each pair of messages of which one can be the beginning of the other."""
    for short, long in begun(model):
        frames = (_grafted(short, long, each.hex) for each in long.message.examples)
        found = (each for each in frames if each is not None and _reads_as_both(model, each))
        yield from list(found)[:1]


def _grafted(short: MessageLayout, long: MessageLayout, data: bytes) -> Lengthened | None:
    """Put the checksums of the shorter message into a frame of the longer; None if none fit."""
    size = short.least
    if len(data) <= size:
        return None
    return Lengthened(short, long, long.sealed(short.sealed(data[:size]) + data[size:]))


def _reads_as_both(model: Model, each: Lengthened) -> bool:
    way = [each.long.direction]
    is_long = weigh_whole(model, way, each.data).message is each.long
    if not is_long or weigh_whole(model, way, each.beginning).message is not each.short:
        return False
    # Reserved bytes are always the same in what is made of values.
    return encode(each.long, each.values) == each.data
