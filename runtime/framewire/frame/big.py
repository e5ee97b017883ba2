"""Numbers of several bytes, of which the highest comes first."""

from __future__ import annotations

from .number import Number


class U16(Number, code="H", order=">"):
    """An unsigned number of two bytes."""

    __slots__ = ()


class U32(Number, code="I", order=">"):
    """An unsigned number of four bytes."""

    __slots__ = ()


class U64(Number, code="Q", order=">"):
    """An unsigned number of eight bytes."""

    __slots__ = ()


class I16(Number, code="h", order=">"):
    """A signed number of two bytes, in two's complement."""

    __slots__ = ()


class I32(Number, code="i", order=">"):
    """A signed number of four bytes, in two's complement."""

    __slots__ = ()


class I64(Number, code="q", order=">"):
    """A signed number of eight bytes, in two's complement."""

    __slots__ = ()
