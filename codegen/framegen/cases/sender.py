"""What one end of a line sends: legal frames, and bytes that resemble them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.cases.unknown_id import unknown_id
from framegen.cases.valid import frames_of, values_at
from framegen.model.codec import encode
from framegen.model.slots import Constant, Number

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# No more messages of one direction have lines of their own, and none whose frames are larger: what
# a line shows does not depend on how many messages there are.
_MESSAGES = 8
_SMALL = 64
# Longer frames than that would show nothing else.
LONGEST = 300
# All bytes that there are, so that neighbours have nothing in common.
_NOISE = [(0x13 + at * 0x25) % 0x100 for at in range(0x100)]


@dataclass(frozen=True)
class Sender:
    """One direction of a protocol in one kind of frame, and what its cases are made of."""

    model: Model
    direction: Direction
    frame: Envelope

    @cached_property
    def header(self) -> bytes:
        """The constant bytes with which a frame begins; without any, its first byte."""
        return self.frame.header or next(iter(self.small_frames.values()), b"")[:1]

    @cached_property
    def messages(self) -> list[MessageLayout]:
        """The messages that are sent so, in the order of the spec."""
        sent = self.model.sent(self.direction)
        return [message for message in sent if message.frame is self.frame]

    @cached_property
    def small_frames(self) -> dict[str, bytes]:
        """A small frame of each of the first messages: the first example that is small."""
        found: dict[str, bytes] = {}
        for message in self.messages:
            frames = (each.data for each in frames_of(message))
            frame = next((each for each in frames if len(each) <= _SMALL), None)
            if frame is not None and len(found) < _MESSAGES:
                found[message.name] = frame
        return found

    @cached_property
    def largest(self) -> int:
        """The size of the largest frame in bytes."""
        return self.model.largest([self.direction])

    def noise(self, size: int) -> bytes:
        """Return `size` bytes of which none occurs in a header, nor begins a frame.

        Where every byte may begin one, they are as good as any.
        """
        calm = self._calm
        return bytes(calm[:1] and [calm[at % len(calm)] for at in range(size)])

    @cached_property
    def _calm(self) -> list[int]:
        if not self.frame.header:
            begin = self.model.first_bytes
            return [byte for byte in _NOISE if byte not in begin] or _NOISE
        headers = {byte for each in self.model.envelopes.values() for byte in each.header}
        return [byte for byte in _NOISE if byte not in headers]

    def enveloped(
        self, ids: Mapping[str, int], body: bytes, size: int | None = None
    ) -> bytes | None:
        """Make a frame with any ids by part, whose length says `size`; None where it cannot.

        It has the right checksums; one that says more than it has lacks what is behind the body.
        """
        envelope = self.frame
        true = envelope.least + len(body)
        length = (true if size is None else size) - envelope.uncounted
        part = envelope.length_part
        if part is None or not part.low <= length <= part.high:
            return None
        data = b""
        for placed in envelope.lay_out(true):
            match placed.slot:
                case Constant() as slot:
                    data += slot.data
                case Number(role="length") as slot:
                    data += slot.write(length)
                case Number(role="id") as slot:
                    data += slot.write(ids[slot.name])
                case Number(role="address") as slot:
                    data += slot.write(slot.low)
                case Number():
                    data += bytes(placed.size)
                case _:
                    data += body
        if size is not None and size > true:
            return data[: len(data) - envelope.tail_size]
        return envelope.sealed(data, ids)

    @cached_property
    def known_ids(self) -> dict[str, int]:
        """The ids of the first message, by part."""
        return {part.name: self.messages[0].id_of(part) for part in self.frame.ids}

    @cached_property
    def unknown_ids(self) -> dict[str, int] | None:
        """Ids by part of which the last one sent is unknown; None where there is none."""
        part = self.frame.id_part
        unknown = None if part is None else unknown_id(self.model, self.direction, self.frame, part)
        return None if part is None or unknown is None else {**self.known_ids, part.name: unknown}

    def unknown(self, body: bytes, size: int | None = None) -> bytes | None:
        """Make a frame with an unknown id and a legal length; None where there is none."""
        shown = self.frame.least + len(body) if size is None else size
        if self.unknown_ids is None or not self.frame.least <= shown <= self.largest:
            return None
        return self.enveloped(self.unknown_ids, body, size)

    def frames_around(self, limit: int) -> tuple[bytes | None, bytes | None]:
        """Return the largest frame of at most `limit` bytes, and the next larger one.

        None where there is none, or none that a line has room for.
        """
        sizes: dict[int, tuple[MessageLayout, int]] = {}
        for message in self.messages:
            for count in _counts_around(message, limit):
                if message.size_at(count) <= LONGEST:
                    sizes.setdefault(message.size_at(count), (message, count))
        within = max((size for size in sizes if size <= limit), default=None)
        beyond = min((size for size in sizes if size > limit), default=None)
        return (
            None if within is None else _lowest(*sizes[within]),
            None if beyond is None else _lowest(*sizes[beyond]),
        )


def _counts_around(message: MessageLayout, limit: int) -> list[int]:
    """Return the counts whose frames have at most `limit` bytes, and just more."""
    first, last = message.counts[0], message.counts[-1]
    if message.optional:
        return list(message.counts)
    step = message.formula.factor or 1
    count = first + (limit - message.size_at(first)) // step
    return sorted({min(max(each, first), last) for each in (count, count + 1)})


def _lowest(message: MessageLayout, count: int) -> bytes:
    return encode(message, values_at(message, "low", count))
