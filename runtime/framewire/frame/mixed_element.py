"""The base of a list's elements that hold text or floating-point numbers, too."""

from __future__ import annotations

from .element import Element

TYPE_CHECKING = False
if TYPE_CHECKING:
    import typing_extensions as typing
else:
    from .typing_later import typing


class MixedElement(Element):
    """A named tuple: equal to the plain tuple of the same values, and as immutable."""

    __slots__ = ()

    def _asdict(self) -> dict[str, typing.Any]:
        """Return the values by name."""
        return {name: getattr(self, name) for name in self._fields}

    def _replace(self, **changes: typing.Any) -> typing.Self:
        """Return another such element, with the given values in place of its own."""
        return super()._replace(**changes)

    __replace__ = _replace  # as `copy.replace` wants it

    def __getnewargs__(self) -> tuple[typing.Any, ...]:
        return tuple(self._asdict().values())
