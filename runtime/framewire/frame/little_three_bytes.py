"""Whole numbers of three bytes, of which the lowest comes first."""

from __future__ import annotations

from .three_bytes import ThreeBytes


class U24(ThreeBytes, code="u", order="<"):
    """An unsigned number of three bytes."""

    __slots__ = ()


class I24(ThreeBytes, code="i", order="<"):
    """A signed number of three bytes, in two's complement."""

    __slots__ = ()
