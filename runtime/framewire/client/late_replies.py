"""Replies that may still come although nobody waits for them any more."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..frame.message import Message


class Origin:
    """The messages of some classes that come from one device: whoever it is, where that is None."""

    __slots__ = ("address", "kinds")

    def __init__(self, kinds: tuple[type[Message], ...], address: int | None) -> None:
        self.kinds = kinds
        self.address = address

    def is_same(self, other: Origin) -> bool:
        """Return whether this is the same."""
        return (self.kinds, self.address) == (other.kinds, other.address)

    def meets(self, other: Origin) -> bool:
        """Return whether there is a message that is of both."""
        if None not in (self.address, other.address) and self.address != other.address:
            return False
        return not set(self.kinds).isdisjoint(other.kinds)


class _Late:
    __slots__ = ("count", "origin", "owed", "until")

    def __init__(self, origin: Origin, count: int, until: float, *, owed: bool) -> None:
        self.origin = origin
        self.count = count
        self.until = until
        self.owed = owed


class LateReplies:
    """Late replies that may still come, by class and device, with the time until when.

    A late reply would look like the answer to the next request of its kind to its device, so that
    one is not sent meanwhile.
    """

    def __init__(self) -> None:
        self._expected: list[_Late] = []
        # Of what a reply was due and has not come at all.
        self._missing: list[Origin] = []

    def __len__(self) -> int:
        return len(self._expected)

    def expect(self, origin: Origin, count: int, until: float, *, owed: bool = True) -> None:
        """Expect up to `count` late replies until a time.

        `owed` is whether the device has been sent requests for them; otherwise it is uncertain
        whether any will come.
        """
        self._expected.append(_Late(origin, count, until, owed=owed))

    def came(self, origin: Origin) -> None:
        """Record that one has come."""
        for each in self._expected:
            if each.origin.meets(origin):
                each.count -= 1
                if not each.count:
                    self._expected.remove(each)
                return

    def forget(self, now: float) -> None:
        """Stop waiting for late replies whose time is over, though they may yet come."""
        gone = [each for each in self._expected if each.until <= now]
        if gone:
            for each in gone:
                if each.owed and not any(each.origin.is_same(other) for other in self._missing):
                    self._missing.append(each.origin)
            self._expected = [each for each in self._expected if each.until > now]

    def awaited(self, origin: Origin, now: float) -> bool:
        """Return whether one of these may come yet."""
        return any(each.origin.meets(origin) and each.until > now for each in self._expected)

    def ends(self) -> Iterator[float]:
        """Return the times until when late replies are waited for."""
        return (each.until for each in self._expected)

    def take_missing(self, origin: Origin) -> bool:
        """Return whether one of these was due and never came, and forget that."""
        left = [each for each in self._missing if not each.meets(origin)]
        missing = len(left) < len(self._missing)
        self._missing = left
        return missing
