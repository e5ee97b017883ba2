"""Numbers that are big endian, in a protocol that is usually little endian."""

from __future__ import annotations

from .floating import Float
from .number import Number
from .three_bytes import ThreeBytes


class SwappedU16(Number, code="H", order=">"):
    """An unsigned number of two bytes, in the other byte order."""

    __slots__ = ()


class SwappedU24(ThreeBytes, code="u", order=">"):
    """An unsigned number of three bytes, in the other byte order."""

    __slots__ = ()


class SwappedU32(Number, code="I", order=">"):
    """An unsigned number of four bytes, in the other byte order."""

    __slots__ = ()


class SwappedU64(Number, code="Q", order=">"):
    """An unsigned number of eight bytes, in the other byte order."""

    __slots__ = ()


class SwappedI16(Number, code="h", order=">"):
    """A signed number of two bytes, in the other byte order."""

    __slots__ = ()


class SwappedI24(ThreeBytes, code="i", order=">"):
    """A signed number of three bytes, in the other byte order."""

    __slots__ = ()


class SwappedI32(Number, code="i", order=">"):
    """A signed number of four bytes, in the other byte order."""

    __slots__ = ()


class SwappedI64(Number, code="q", order=">"):
    """A signed number of eight bytes, in the other byte order."""

    __slots__ = ()


class SwappedF32(Float, code="f", order=">"):
    """A floating-point number of four bytes, in the other byte order."""

    __slots__ = ()


class SwappedF64(Float, code="d", order=">"):
    """A floating-point number of eight bytes, in the other byte order."""

    __slots__ = ()
