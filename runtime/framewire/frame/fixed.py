"""Bytes of a message that nobody gives: constants, which are checked, and reserved ones."""

from __future__ import annotations

from .bytes_like import format_hex

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from typing import Any, ClassVar

    from .field import Place


class Always:
    """Bytes that are the same in every frame, at an offset in the frame or in its element."""

    __slots__ = ("at", "data", "name")

    varies: ClassVar[bool] = False
    """Whether their number varies from frame to frame: never."""

    def __init__(self, name: str, at: int, data: bytes) -> None:
        self.name = name
        self.at = at
        self.data = data

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r}, {self.at}, {self.data!r})"

    @property
    def there(self) -> Always:
        """These: they are absent in no frame."""
        return self

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in them: all of them."""
        return [(self.at, self.at + len(self.data), self.data)]

    def within(self, _body: bytes, /) -> Iterator[tuple[str, int, Any]]:
        """Yield what they hold in a frame, by its path, and where the place of that counts from."""
        yield self.name, 0, self

    def explained(self, data: bytes, _at: int, /) -> str:
        """Return what is wrong with the bytes that stand there instead."""
        return f"is {format_hex(data)}, and always {format_hex(self.data)}"


class Reserved(Always):
    """Bytes without a meaning: always written so, and read as anything."""

    __slots__ = ()

    @property
    def places(self) -> Sequence[Place]:
        """What can be wrong in them: nothing."""
        return ()
