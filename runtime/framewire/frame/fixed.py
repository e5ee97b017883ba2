"""Bytes of a message that nobody gives: constants, which are checked, and reserved ones."""

from __future__ import annotations


class Always:
    """Bytes that are the same in every frame, at an offset in the frame or in its element."""

    __slots__ = ("at", "data", "name")

    def __init__(self, name: str, at: int, data: bytes) -> None:
        self.name = name
        self.at = at
        self.data = data

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}, {self.at}, {self.data!r})"


class Reserved(Always):
    """Bytes without a meaning: always written so, and read as anything."""

    __slots__ = ()
