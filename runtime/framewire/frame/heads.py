"""Where frames begin, and how large they are."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable

    from .envelope import Envelope

# How much of a line is searched at once.
_STRETCH = 256


class Heads:
    """The beginnings of all frames of a protocol, from its envelopes: each of these leads to it.

    `proves` says of a whole frame whether its only checksum is right, where one test does for all
    frames: it is quicker than what the envelopes know of it. Where that is a sum, and the bytes of
    any frame add up to the same with it, `total` is that modulo 256: decoders add it up in place.
    """

    def __init__(
        self,
        envelopes: tuple[Envelope, ...],
        *,
        proves: Callable[[bytes], bool] | None = None,
        total: int | None = None,
    ) -> None:
        self.envelopes = envelopes
        self.proves = proves
        self.total = total
        self.longest = max(1, *(envelope.body_at for envelope in envelopes))
        """How many bytes stand in front of the fields, at the most; 1 if there are none."""
        self.least = min(envelope.least for envelope in envelopes)
        """The size of the smallest frame there may be."""
        self.first_bytes = frozenset[int]().union(*(each.first_bytes for each in envelopes))
        """The bytes with which a frame may begin."""
        self._others = bytes({*range(0x100)} - self.first_bytes)
        # The header, where all frames have the same; the beginnings of it that more bytes may
        # complete.
        headers = {envelope.header for envelope in envelopes}
        self._header = header = headers.pop() if len(headers) == 1 else b""
        self._begun = tuple(header[:size] for size in range(len(header) - 1, 0, -1))
        # What begins with no header, or with a single byte as an acknowledgement may, can be
        # anywhere in a frame by chance.
        self.telling = {each.header for each in envelopes if each.header and each.body_at > 1}
        """The headers that tell that a frame begins."""
        self.telling_begun = tuple(
            header[:size] for header in self.telling for size in range(1, len(header))
        )
        """The beginnings of these that more bytes may complete."""
        for envelope in envelopes:
            envelope.heads = self

    def begins(self, data: bytes, at: int = 0) -> bool:
        """Return whether a frame may begin at data[at], as far as its header goes."""
        return any(envelope.begins(data, at) for envelope in self.envelopes)

    def next_begun(self, data: bytes, at: int) -> int:
        """Return where from data[at] on a frame may begin; the end if nowhere."""
        if self._header:
            found = data.find(self._header, at)
            if found >= 0:
                return found
            for begun in self._begun:
                if data.endswith(begun, at):
                    return len(data) - len(begun)
            return len(data)
        others = self._others
        while at < len(data):
            stretch = data[at : at + _STRETCH]
            rest = stretch.lstrip(others)
            at += len(stretch) - len(rest)
            if rest:
                break
        return at

    def claimed(self, data: bytes) -> int:
        """Return how large the frame would be that `data` begins; 0 where it does not say so."""
        for envelope in self.envelopes:
            length = envelope.length
            if length and envelope.begins(data, 0) and len(data) >= length.at + length.size:
                return envelope.size(length.read(data))
        return 0

    def fitting(self, frame: bytes) -> Envelope:
        """Return the envelope that a frame of any id may have. Raises ValueError for none."""
        for envelope in self.envelopes:
            if envelope.fits(frame):
                return envelope
        raise ValueError("no frame is like that")
