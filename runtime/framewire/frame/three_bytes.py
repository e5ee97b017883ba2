"""Fields that are whole numbers of three bytes, which `struct` does not know."""

from __future__ import annotations

from operator import index

from .number import ANY_ORDER, Number

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from typing import Any, Literal

_SIZE = 3
_ORDERS: dict[str, Literal["little", "big"]] = {"<": "little", ">": "big"}


class ThreeBytes(Number, code="3s", order=ANY_ORDER):
    """A whole number of three bytes; `struct` takes it as bytes."""

    __slots__ = ()

    def __init_subclass__(cls, *, code: str, order: str) -> None:
        super().__init_subclass__(code="3s", order=order)
        signed = code == "i"
        made: Any = _Struct(order, signed=signed)
        cls.struct = made
        cls.lowest = -1 << 23 if signed else 0
        cls.highest = cls.lowest + (1 << 24) - 1


class _Struct:
    """Packs and unpacks such numbers, as a `Struct` does it with others."""

    __slots__ = ("order", "signed")

    size = _SIZE

    def __init__(self, order: str, *, signed: bool) -> None:
        self.order: Literal["little", "big"] = _ORDERS[order]
        self.signed = signed

    def pack(self, number: int) -> bytes:
        """Return the number as bytes."""
        return index(number).to_bytes(_SIZE, self.order, signed=self.signed)

    def unpack(self, data: bytes) -> tuple[int]:
        """Return the number that these bytes hold, in a tuple."""
        return (int.from_bytes(data, self.order, signed=self.signed),)

    def unpack_from(self, data: bytes, at: int = 0) -> tuple[int]:
        """Return the number at an offset, in a tuple."""
        return self.unpack(data[at : at + _SIZE or None])
