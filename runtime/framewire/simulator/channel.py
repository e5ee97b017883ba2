"""One direction of a line: bytes go in at any time, and come out when the wire has carried them."""

from __future__ import annotations

from collections import deque


class Channel:
    """A queue that delivers bytes in order. With 0 seconds a byte, they arrive at once."""

    def __init__(self, seconds_per_byte: float = 0.0) -> None:
        self.seconds_per_byte = seconds_per_byte
        # When the last byte is out.
        self.free_at = 0.0
        self._pieces: deque[tuple[float, bytes]] = deque()

    @property
    def next_event(self) -> float | None:
        """When the next byte is out; None while there is none."""
        return self._pieces[0][0] if self._pieces else None

    @property
    def held(self) -> int:
        """How many bytes are on their way."""
        return sum(len(data) for _, data in self._pieces)

    def put(self, data: bytes, moment: float, seconds_per_byte: float | None = None) -> None:
        """Put bytes behind those that are on their way, on a paced line at a speed of their own."""
        if not data:
            return
        start = max(moment, self.free_at)
        each = self.seconds_per_byte
        if each and seconds_per_byte is not None:
            each = seconds_per_byte
        if each:
            self._pieces.extend(
                (start + (count + 1) * each, data[count : count + 1]) for count in range(len(data))
            )
        else:
            self._pieces.append((start, data))
        self.free_at = start + len(data) * each

    def take(self, moment: float) -> list[bytes]:
        """Return the pieces that are out by then; on a paced line they are one piece."""
        found: list[bytes] = []
        while self._pieces and self._pieces[0][0] <= moment:
            found.append(self._pieces.popleft()[1])
        return [b"".join(found)] if found and self.seconds_per_byte else found

    def clear(self) -> None:
        """Discard the bytes that are on their way."""
        self._pieces.clear()
        self.free_at = 0.0
