"""Recognise frames of a protocol that is easily taken for this one, in bytes of any origin."""

from __future__ import annotations

from ..frame.errors import DecodeError

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from typing import Any, Literal, Protocol

    from .protocol_codec import ProtocolCodec

    class Method(Protocol):
        """What works out a checksum."""

        def running(self) -> Any:
            """Return what works it out along a stream."""


# Bytes enough to recognise one; a search through more would only take longer.
_SEARCHED = 16384


class Lookalike:
    """A protocol that is easily taken for this one, and where the parts of its frames stand.

    `constants` are places with the bytes that stand there; `length` is the place of a number that
    says how many bytes a frame has besides `uncounted`; `least` is the size of the smallest frame;
    `command` is the place of its command, and `commands` are those known, empty for any.
    `checksums` are places, each with the places whose inverted sum stands there, or what one of the
    `methods` makes of them. A number in the other byte order has a place that goes backwards.
    """

    __slots__ = (
        "checksums",
        "command",
        "commands",
        "constants",
        "least",
        "length",
        "methods",
        "order",
        "title",
        "uncounted",
    )

    def __init__(
        self,
        title: str,
        order: Literal["little", "big"],
        *,
        constants: tuple[tuple[slice, bytes], ...],
        length: slice,
        uncounted: int,
        least: int,
        command: slice,
        commands: tuple[int, ...],
        checksums: tuple[tuple[slice, tuple[slice, ...]], ...],
        methods: tuple[Method, ...] = (),
    ) -> None:
        self.title = title
        self.order: Literal["little", "big"] = order
        self.constants = constants
        self.length = length
        self.uncounted = uncounted
        self.least = least
        self.command = command
        self.commands = frozenset(commands)
        self.checksums = checksums
        self.methods = methods

    def covered(self, data: bytes, codec: ProtocolCodec) -> int:
        """Return how many bytes of `data` are frames of this protocol, and no messages of ours."""
        found = at = 0
        header = next((text for place, text in self.constants if place.start == 0), b"")
        # Whatever claims to be a frame, no byte is summed again and again.
        running = [method.running() for method in self.methods]
        while (at := data.find(header, at)) >= 0 and at + self.least <= len(data):
            size = self.uncounted + self._number(data[at : at + self.least][self.length])
            frame = data[at : at + size]
            # Without a checksum, a frame with another header in it proves nothing.
            if (
                self._is_frame(frame)
                and self._is_sealed(frame, data, at, running)
                and (self.checksums or frame.rfind(header) <= 0)
                and not _is_message(frame, codec)
            ):
                found += len(frame)
                at += len(frame)
            else:
                at += 1
        return found

    def _number(self, data: bytes) -> int:
        return int.from_bytes(data, self.order)

    def _is_frame(self, frame: bytes) -> bool:
        if len(frame) < self.least or any(frame[place] != text for place, text in self.constants):
            return False
        if self._number(frame[self.length]) + self.uncounted != len(frame):
            return False
        return not self.commands or self._number(frame[self.command]) in self.commands

    def _is_sealed(self, frame: bytes, data: bytes, at: int, running: Sequence[Any]) -> bool:
        for number, (place, covered) in enumerate(self.checksums):
            if running:
                pieces = (each.indices(len(frame)) for each in covered)
                moved = [(at + start, at + end) for start, end, _ in pieces]
                value = running[number].of(data, 0, *moved)
            else:
                mask = (1 << 8 * len(frame[place])) - 1
                value = ~sum(sum(frame[each]) for each in covered) & mask
            if self._number(frame[place]) != value:
                return False
        return True


def most_likely(lookalikes: Iterable[Lookalike], data: bytes, codec: ProtocolCodec) -> str | None:
    """Return the title of the protocol whose frames make up most of `data`, at least half of it."""
    searched = data[:_SEARCHED]

    def shares() -> Iterator[tuple[int, str]]:
        for each in lookalikes:
            yield each.covered(searched, codec), each.title

    covered, title = max(shares(), key=lambda share: share[0], default=(0, ""))
    return title if covered and 2 * covered >= len(searched) else None


def _is_message(frame: bytes, codec: ProtocolCodec) -> bool:
    try:
        codec.decode(frame, None)
    except DecodeError:
        return False
    return True
