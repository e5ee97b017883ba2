"""Numbers in the byte order that is not the usual one of the protocol."""

from __future__ import annotations

from .floating import Float
from .number import Number
from .protocol import STRUCT_ORDER
from .three_bytes import ThreeBytes

_ORDER = "<" if STRUCT_ORDER == ">" else ">"


class SwappedU16(Number, code="H", order=_ORDER):
    """An unsigned number of two bytes, in the other byte order."""

    __slots__ = ()


class SwappedU24(ThreeBytes, code="u", order=_ORDER):
    """An unsigned number of three bytes, in the other byte order."""

    __slots__ = ()


class SwappedU32(Number, code="I", order=_ORDER):
    """An unsigned number of four bytes, in the other byte order."""

    __slots__ = ()


class SwappedU64(Number, code="Q", order=_ORDER):
    """An unsigned number of eight bytes, in the other byte order."""

    __slots__ = ()


class SwappedI16(Number, code="h", order=_ORDER):
    """A signed number of two bytes, in the other byte order."""

    __slots__ = ()


class SwappedI24(ThreeBytes, code="i", order=_ORDER):
    """A signed number of three bytes, in the other byte order."""

    __slots__ = ()


class SwappedI32(Number, code="i", order=_ORDER):
    """A signed number of four bytes, in the other byte order."""

    __slots__ = ()


class SwappedI64(Number, code="q", order=_ORDER):
    """A signed number of eight bytes, in the other byte order."""

    __slots__ = ()


class SwappedF32(Float, code="f", order=_ORDER):
    """A floating-point number of four bytes, in the other byte order."""

    __slots__ = ()


class SwappedF64(Float, code="d", order=_ORDER):
    """A floating-point number of eight bytes, in the other byte order."""

    __slots__ = ()
