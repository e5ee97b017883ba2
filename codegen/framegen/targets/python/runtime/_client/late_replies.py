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
    """What is late, by the class of the reply, and until when it is waited for.

    A late reply would look like the answer to the next question of its kind, so that one is not
    asked meanwhile.
    """

    def __init__(self) -> None:
        self._expected: list[_Late] = []
        # The kinds of which one was owed, and has not come at all.
        self._missing: set[type[Message]] = set()

    def __len__(self) -> int:
        return len(self._expected)

    def expect(self, kind: type[Message], count: int, until: float, *, owed: bool = True) -> None:
        """Says that so many may come up to a time.

        `owed` is whether the device has been asked for them; or else it is only doubtful whether
        there are any.
        """
        self._expected.append(_Late(kind, count, until, owed=owed))

    def came(self, kind: type[Message]) -> None:
        """Says that one of a kind has come."""
        for each in self._expected:
            if each.kind is kind:
                each.count -= 1
                if not each.count:
                    self._expected.remove(each)
                return

    def forget(self, now: float) -> None:
        """No longer waits for what has not come for too long, though it may yet."""
        gone = [each for each in self._expected if each.until <= now]
        if gone:
            self._missing.update(each.kind for each in gone if each.owed)
            self._expected = [each for each in self._expected if each.until > now]

    def awaited(self, kind: type[Message], now: float) -> bool:
        """Whether one of a kind may come yet."""
        return any(each.kind is kind and each.until > now for each in self._expected)

    def ends(self) -> Iterator[float]:
        """Until when each is waited for."""
        return (each.until for each in self._expected)

    def take_missing(self, kind: type[Message]) -> bool:
        """Whether one of a kind was owed and never came; asked once, it is forgotten."""
        missing = kind in self._missing
        self._missing.discard(kind)
        return missing
