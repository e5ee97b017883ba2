"""Replies that may still come although nobody waits for them any more."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from .._frame.message import Message


class _Late:
    __slots__ = ("count", "kind", "owed", "until")

    def __init__(self, kind: type[Message], count: int, until: float, *, owed: bool) -> None:
        self.kind = kind
        self.count = count
        self.until = until
        self.owed = owed


class LateReplies:
    """Late replies that may still come, by the class of the reply, with the time until when.

    A late reply would look like the answer to the next request of its kind, so that one is not sent
    meanwhile.
    """

    def __init__(self) -> None:
        self._expected: list[_Late] = []
        # The kinds of which a reply was due and has not come at all.
        self._missing: set[type[Message]] = set()

    def __len__(self) -> int:
        return len(self._expected)

    def expect(self, kind: type[Message], count: int, until: float, *, owed: bool = True) -> None:
        """Expect up to `count` late replies until a time.

        `owed` is whether the device has been sent requests for them; otherwise it is uncertain
        whether any will come.
        """
        self._expected.append(_Late(kind, count, until, owed=owed))

    def came(self, kind: type[Message]) -> None:
        """Record that one of a kind has come."""
        for each in self._expected:
            if each.kind is kind:
                each.count -= 1
                if not each.count:
                    self._expected.remove(each)
                return

    def forget(self, now: float) -> None:
        """Stop waiting for late replies whose time is over, though they may yet come."""
        gone = [each for each in self._expected if each.until <= now]
        if gone:
            self._missing.update(each.kind for each in gone if each.owed)
            self._expected = [each for each in self._expected if each.until > now]

    def awaited(self, kind: type[Message], now: float) -> bool:
        """Return whether one of a kind may come yet."""
        return any(each.kind is kind and each.until > now for each in self._expected)

    def ends(self) -> Iterator[float]:
        """Return the times until when late replies are waited for."""
        return (each.until for each in self._expected)

    def take_missing(self, kind: type[Message]) -> bool:
        """Return whether a reply of a kind was due and never came, and forget that."""
        missing = kind in self._missing
        self._missing.discard(kind)
        return missing
